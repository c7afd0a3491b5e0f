// Normals from cross products with a bound of their rounding; corners that neighbouring triangles share are placed once.
#include "core/coplanarity/facets.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

namespace copeel {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

// No plane of practice is orthogonal to this direction, so that the sign of a normal is stable under rounding.
const glm::dvec3 kHalf = glm::normalize(glm::dvec3(0.3568220897730899, 0.5773502691896258, 0.7343224509861237));

struct Corners {
  glm::dvec3 a, b, c;
};

// Calls visit(triangle, corners) with the placed corners. The cut of a polygon goes on at the last triangle's first corner, mostly.
template <class Visit>
void forEachPlaced(const Object& object, FacetRange range, Visit visit) {
  const Mesh& mesh = *object.mesh;
  const auto place = [&](std::uint32_t vertex) { return transformPoint(object.worldFromObject, mesh.vertices[vertex]); };
  Corners corners{};
  glm::uvec3 last(0);
  for (std::uint32_t t = range.begin; t < range.end; ++t) {
    const glm::uvec3 index = mesh.triangles[t];
    const bool goesOn = t > range.begin && index.x == last.x;
    const glm::dvec3 second = goesOn && index.y == last.z ? corners.c : place(index.y);
    corners = {goesOn ? corners.a : place(index.x), second, place(index.z)};
    last = index;
    visit(t, corners);
  }
}

// A normal for a facet without area: orthogonal to its longest edge. It covers edge pixels at most, and its depth is held to its range.
glm::dvec3 needleNormal(const Corners& corners) {
  const auto& [p, q, r] = corners;
  glm::dvec3 along = q - p;
  for (const glm::dvec3& other : {r - p, r - q}) {
    if (glm::dot(other, other) > glm::dot(along, along)) along = other;
  }
  const glm::dvec3 side = std::abs(along.x) < std::abs(along.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 normal = glm::cross(along, side);
  const double length = glm::length(normal);
  return length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0, 0, 1);
}

}  // namespace

FacetRange rangeFrom(const Mesh& mesh, std::uint32_t begin, std::uint32_t facet) {
  if (mesh.facets.empty()) return {facet, facet + 1};
  FacetRange range{begin, begin};
  while (range.end < mesh.facets.size() && mesh.facets[range.end] == facet) ++range.end;
  return range;
}

FacetRange rangeOf(const Mesh& mesh, std::uint32_t facet) {
  const auto begin = std::lower_bound(mesh.facets.begin(), mesh.facets.end(), facet);
  return rangeFrom(mesh, static_cast<std::uint32_t>(begin - mesh.facets.begin()), facet);
}

double turnOf(const glm::dvec3& normal) { return glm::dot(normal, kHalf); }

FacetPlane planeOf(const Object& object, FacetRange range) {
  FacetPlane result;
  double best = -1;
  glm::dvec3 normal{0};
  Corners largest{};
  forEachPlaced(object, range, [&](std::uint32_t triangle, const Corners& corners) {
    const auto& [a, b, c] = corners;
    result.box.add(a), result.box.add(b), result.box.add(c);
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double area = glm::length(n);
    if (!(area > best)) return;
    best = area, normal = n, largest = corners, result.triangle = triangle;
  });
  // Each component of the cross product carries four roundings of products no larger than the two edges'.
  const double magnitude = glm::length(largest.b - largest.a) * glm::length(largest.c - largest.a);
  const double error = best > 0 ? 8 * kEps * magnitude / best : 1.0;
  result.normal = error < 0.25 ? normal / best : needleNormal(largest);
  if (turnOf(result.normal) < 0) result.normal = -result.normal;
  result.error = std::min(error * 1.001 + 4 * kEps, 1.0);
  result.point = largest.a;
  return result;
}

double doubledArea(const Object& object, std::uint32_t triangle) {
  double area = 0;
  forEachPlaced(object, {triangle, triangle + 1}, [&](std::uint32_t, const Corners& corners) {
    area = glm::length(glm::cross(corners.b - corners.a, corners.c - corners.a));
  });
  return area;
}

FacetExtent extentOf(const Object& object, FacetRange range, const glm::dvec3& normal, const glm::dvec3& point) {
  FacetExtent result;
  double radiusSquared = 0;
  forEachPlaced(object, range, [&](std::uint32_t, const Corners& corners) {
    for (const glm::dvec3& corner : {corners.a, corners.b, corners.c}) {
      const glm::dvec3 away = corner - point;
      result.flatness = std::max(result.flatness, std::abs(glm::dot(normal, away)));
      radiusSquared = std::max(radiusSquared, glm::dot(away, away));
      result.box.add(corner);
    }
  });
  result.radius = std::sqrt(radiusSquared) * (1 + 4 * kEps);
  return result;
}

}  // namespace copeel
