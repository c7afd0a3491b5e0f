// Solid angles by: Van Oosterom, Strackee. The solid angle of a plane triangle. IEEE Trans. Biomed. Eng. 30, 1983.
#include "apps/csg/eye_winding.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace copeel::csg {
namespace {

double solidAngle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
  const double numerator = glm::dot(a, glm::cross(b, c));
  const double denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
  return 2 * std::atan2(numerator, denominator);
}

double generalisedWinding(const Scene& scene, std::uint32_t object, const glm::dvec3& eye) {
  const Object& placed = scene.objects()[object];
  double sum = 0;
  for (const glm::uvec3& t : placed.mesh->triangles) {
    sum += solidAngle(scene.worldVertex(object, t.x) - eye, scene.worldVertex(object, t.y) - eye, scene.worldVertex(object, t.z) - eye);
  }
  const double mirror = glm::determinant(glm::dmat3(placed.worldFromObject)) < 0 ? -1 : 1;
  return mirror * sum / (4 * std::numbers::pi);
}

bool insideBox(const Scene& scene, std::uint32_t object, const glm::dvec3& eye) {
  Box box;
  for (const glm::uvec3& t : scene.objects()[object].mesh->triangles) {
    for (int k = 0; k < 3; ++k) box.add(scene.worldVertex(object, t[k]));
  }
  return glm::all(glm::greaterThanEqual(eye, box.min)) && glm::all(glm::lessThanEqual(eye, box.max));
}

}  // namespace

EyeWinding eyeWinding(const Scene& scene, const glm::dvec3& eye, const std::vector<std::uint8_t>& reachesEye,
                      const std::vector<std::uint8_t>& closed) {
  EyeWinding result;
  result.fromStack.assign(scene.objects().size(), 0);
  result.constant.assign(scene.objects().size(), 0);
  for (std::uint32_t object = 0; object < scene.objects().size(); ++object) {
    if (!reachesEye[object]) continue;
    if (closed[object]) {
      result.fromStack[object] = 1;
    } else if (insideBox(scene, object, eye)) {
      result.constant[object] = static_cast<std::int32_t>(std::lround(generalisedWinding(scene, object, eye)));
    }
    result.any |= result.fromStack[object] || result.constant[object] != 0;
  }
  return result;
}

}  // namespace copeel::csg
