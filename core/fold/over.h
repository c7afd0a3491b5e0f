// core/fold/over.glsl as C++, and the tables that both back ends read a fragment's colour from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/coplanarity/plane_classes.h"
#include "core/fold/common_glsl.h"
#include "core/fold/light.h"
#include "core/scene/view.h"
#include "core/uninitialized.h"

namespace copeel::fold {

using glm::clamp, glm::dvec3, glm::min, glm::uvec3, glm::vec3, glm::vec4;

#include "core/fold/over.glsl"

// Where an object's own colours lie: triangle t of it has bases[first + stride · t].
struct BaseRange {
  std::uint32_t first = 0;
  std::uint32_t stride = 0;   // 0: one colour for the object, 1: one a triangle
};

using Shades = UninitializedVector<float>;   // per plane class, of one view

// As a shader storage buffer takes them: vec4, uvec2 and float arrays without padding. A fragment's colour is
// overShade(bases[first + stride · triangle], shades[class]).
struct OverTables {
  std::vector<vec4> bases;          // 0 … 255, and alpha
  std::vector<BaseRange> ranges;    // per object
  Shades shades;

  void addObject(const vec4& color);
  void addObject(std::span<const vec4> colorOfTriangle);
};
static_assert(sizeof(vec4) == 16 && sizeof(BaseRange) == 8);

// 0.2 + Σ strength · |n·l| over the lights, l of length 1, the same from both sides of a face; 1 where nothing is lit. openscad's light gives openscad's shades.
Shades shadesOf(const PlaneClasses& planes, const View& view, bool lit, const std::vector<Light>& lights = openscadLights());

}  // namespace copeel::fold
