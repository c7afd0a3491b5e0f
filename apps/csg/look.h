// How surfaces look: openscad's preview. A leaf's own colour goes before the scheme's, and before the grey of %, but not before that of #.
// The light is that of shadesOf (core/fold/over.h), blended in float.
#pragma once

#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "apps/csg/csg_fold.h"
#include "core/fold/over.h"

namespace copeel::csg {

class Look {
 public:
  Look(const Model& model, const GateForest& forest, const RenderOptions& options);

  void setView(const PlaneClasses& planes, const View& view) { shade_ = fold::shadesOf(planes, view, options_.lit, options_.lights); }
  double alpha(std::uint32_t leaf, std::uint32_t part) const { return colorOf(leaf, part).a; }
  glm::dvec3 blend(std::span<const Surface> frontToBack) const;   // 0 … 255, over the background

 private:
  glm::dvec4 colorOf(std::uint32_t leaf, std::uint32_t part) const { return part == 0 ? leafColors_[leaf] : overlayColor(leaf, part); }
  glm::dvec4 overlayColor(std::uint32_t leaf, std::uint32_t part) const;

  const Model& model_;
  const RenderOptions& options_;
  std::vector<glm::dvec4> leafColors_;   // 0 … 255 and alpha, as parts of the solid
  fold::Shades shade_;
};

}  // namespace copeel::csg
