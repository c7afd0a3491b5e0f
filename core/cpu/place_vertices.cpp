// Dispatch; the code is in place_vertices-inl.h, compiled once per target.
#include "core/cpu/place_vertices.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/cpu/place_vertices-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/cpu/place_vertices-inl.h"

namespace copeel::cpu {

HWY_EXPORT(PlaceVertices);

bool placeVertices(const Placement& placement, std::span<const glm::dvec3> vertices, glm::ivec2* out) {
  return HWY_DYNAMIC_DISPATCH(PlaceVertices)(placement, vertices, out);
}

}  // namespace copeel::cpu
