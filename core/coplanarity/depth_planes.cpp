// The code is in depth_planes-inl.h, compiled once per SIMD target: eight classes at once, each target with the same operations in the same order.
#include "core/coplanarity/depth_planes.h"

#include <algorithm>

#include <glm/geometric.hpp>

#include "core/parallel.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/coplanarity/depth_planes-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/coplanarity/depth_planes-inl.h"

namespace copeel {
namespace {

constexpr double kNearPerScene = 1e-10;   // of the scene's diagonal plus the distance to it
constexpr double kLeastNear = 1e-37;       // -1/t is held in float

HWY_EXPORT(SetDepthPlanes);

}  // namespace

double nearDistance(const Scene& scene, const View& view) {
  const double reach = scene.bounds().diagonal() + glm::length(scene.bounds().center() - view.eye);
  return std::max(kNearPerScene * reach, kLeastNear);
}

DepthPlanes depthPlanes(const Scene& scene, const PlaneClasses& planes, const View& view) {
  const DepthView setup{view,
                        nearDistance(scene, view),
                        view.width * 0.5 + 1,
                        view.height * 0.5 + 1,
                        glm::length(view.right),
                        glm::length(view.down)};
  constexpr std::size_t kSize = PlaneClassGroup::kSize;
  const PlaneClassList classes = planes.classes();
  DepthPlanes result(classes.size());
  parallelFor((result.size() + kSize - 1) / kSize, 128, [&](std::size_t begin, std::size_t end) {
    const std::size_t first = begin * kSize, count = std::min(end * kSize, result.size()) - first;
    HWY_DYNAMIC_DISPATCH(SetDepthPlanes)(scene, classes.groups() + begin, count, setup, result.data() + first);
  });
  return result;
}

}  // namespace copeel
