// Affine depth functions with a running error bound (Higham, Accuracy and Stability of Numerical Algorithms, section 3.3, kept simple:
// every sum of k products is charged k+1 roundings of the sum of magnitudes).
#include "core/coplanarity/depth_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include <glm/geometric.hpp>

#include "core/parallel.h"

namespace copeel {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kNearPerScene = 1e-10;   // of the scene's diagonal plus the distance to it
constexpr double kLeastNear = 1e-37;       // -1/t is held in float
constexpr float kInf = std::numeric_limits<float>::infinity();

// The next float after a rounded value, as std::nextafter has it, which libraries keep out of line: floats of one sign are ordered as their bits.
float above(double v) {
  const auto rounded = static_cast<float>(v);
  if (!(std::abs(rounded) < kInf)) return std::nextafter(rounded, kInf);
  if (rounded == 0) return std::numeric_limits<float>::denorm_min();
  return std::bit_cast<float>(std::bit_cast<std::uint32_t>(rounded) + (rounded > 0 ? 1 : ~0u));
}
float below(double v) { return -above(-v); }

struct Setup {
  const View& view;
  double nearest;
  double halfWidth, halfHeight;   // largest |u|, |v|
  double right, down;             // lengths
};

void setRange(DepthPlane& plane, const PlaneClass& planeClass, const Setup& setup) {
  const glm::dvec3 lower(planeClass.boundsMin), upper(planeClass.boundsMax);
  const glm::dvec3 middle = (lower + upper) * 0.5, half = (upper - lower) * 0.5;
  const glm::dvec3 f = setup.view.forward;
  const double t = glm::dot(f, middle - setup.view.eye);
  const double reach = (std::abs(f.x) * half.x + std::abs(f.y) * half.y + std::abs(f.z) * half.z) * (1 + 8 * kEps);
  const double tMin = t - reach, tMax = t + reach;
  if (setup.view.perspective) {
    plane.lo = below(-1 / std::max(tMin, setup.nearest));
    plane.hi = above(-1 / std::max(tMax, setup.nearest));
  } else {
    plane.lo = below(tMin);
    plane.hi = above(tMax);
  }
}

DepthPlane depthPlane(const Scene& scene, const PlaneClass& planeClass, const Setup& setup) {
  const View& view = setup.view;
  const glm::dvec3 n = planeClass.normal;
  const Object& object = scene.objects()[planeClass.object];
  const glm::dvec3 p =
      transformPoint(object.worldFromObject, object.mesh->vertices[object.mesh->triangles[planeClass.triangle].x]) - view.eye;
  const double alongPoint = glm::dot(n, p), alongForward = glm::dot(n, view.forward);
  const double alongRight = glm::dot(n, view.right), alongDown = glm::dot(n, view.down);
  const double unit = double(planeClass.normalError) + 8 * kEps;   // error of a dot product with n, per length of the other vector
  const double pointError = unit * glm::length(p);

  DepthPlane plane;
  setRange(plane, planeClass, setup);
  // s = numerator / denominator; the errors of both bound the error of s.
  const double denominator = view.perspective ? alongPoint : alongForward;
  const double denominatorError = view.perspective ? pointError : unit;
  const double constant = view.perspective ? alongForward : alongPoint;
  const double rays = setup.halfWidth * setup.right + setup.halfHeight * setup.down;
  const double numeratorError = unit * rays + (view.perspective ? unit : pointError);
  if (!(std::abs(denominator) > 4 * denominatorError)) {
    plane.c = 0.5 * (double(plane.lo) + double(plane.hi));
    plane.error = kInf;
    return plane;
  }
  const double sign = view.perspective ? -1 : 1;
  plane.a = -alongRight / denominator;
  plane.b = -alongDown / denominator;
  plane.c = sign * constant / denominator;
  const double largest = std::max(std::abs(double(plane.lo)), std::abs(double(plane.hi)));
  const double evaluation = 8 * kEps * (std::abs(plane.a) * setup.halfWidth + std::abs(plane.b) * setup.halfHeight + std::abs(plane.c));
  const double propagated = 2 * (numeratorError + largest * denominatorError) / std::abs(denominator);
  plane.error = above(evaluation + propagated);
  return plane;
}

}  // namespace

double nearDistance(const Scene& scene, const View& view) {
  const double reach = scene.bounds().diagonal() + glm::length(scene.bounds().center() - view.eye);
  return std::max(kNearPerScene * reach, kLeastNear);
}

std::vector<DepthPlane> depthPlanes(const Scene& scene, const PlaneClasses& planes, const View& view) {
  const Setup setup{view,
                    nearDistance(scene, view),
                    view.width * 0.5 + 1,
                    view.height * 0.5 + 1,
                    glm::length(view.right),
                    glm::length(view.down)};
  std::vector<DepthPlane> result(planes.classes().size());
  parallelFor(result.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) result[i] = depthPlane(scene, planes.classes()[i], setup);
  });
  return result;
}

}  // namespace copeel
