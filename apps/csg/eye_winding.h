// Winding numbers at the eye, for leaves that the eye may be inside of.
#pragma once

#include <cstdint>
#include <vector>

#include "core/scene/scene.h"

namespace copeel::csg {

// How a leaf starts along the rays of a view.
struct EyeWinding {
  // Closed leaves that reach behind the near distance: along any ray all crossings sum to minus the winding number at its start.
  std::vector<std::uint8_t> fromStack;
  // Open leaves that do: the generalised winding number at the eye, rounded. Zero for all others.
  std::vector<std::int32_t> constant;
  bool any = false;
};

// `reachesEye`: per object, from the projection. `closed`: per object. Based on: Jacobson, Kavan, Sorkine-Hornung. Robust inside-outside
// segmentation using generalized winding numbers. SIGGRAPH 2013 (for the open ones).
EyeWinding eyeWinding(const Scene& scene, const glm::dvec3& eye, const std::vector<std::uint8_t>& reachesEye,
                      const std::vector<std::uint8_t>& closed);

}  // namespace copeel::csg
