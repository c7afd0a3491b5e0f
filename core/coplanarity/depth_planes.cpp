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
  DepthPlanes result(planes.classes().size());
  parallelFor(result.size(), 1024, [&](std::size_t begin, std::size_t end) {
    HWY_DYNAMIC_DISPATCH(SetDepthPlanes)(scene, planes.classes().data() + begin, end - begin, setup, result.data() + begin);
  });
  return result;
}

}  // namespace copeel
