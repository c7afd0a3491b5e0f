// Based on: Meisters. Polygons have ears. Amer. Math. Monthly 82, 1975; only reflex corners are tested against an ear, as in
// ElGindy, Everett, Toussaint. Slicing an ear using prune-and-search. Pattern Recognition Letters 14, 1993.
// A polygon that crosses itself has no right cut: what is left when no ear can be found is fanned, so that no corner is lost.
#include "core/formats/polygon.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace copeel {
namespace {

// How far corners may lie off their common plane. Rounding to float32 moves a corner by sqrt(3)/2 ulp at most and tilts the mean plane as much
// again; for doubles, the film that is told apart from rounding is 1e-10 of the extent, as in the coplanarity module.
constexpr double kFloatRounding = 4.0 / (1 << 24);  // of the largest coordinate
constexpr double kDoubleRounding = 4.0 / 9007199254740992.0;
constexpr double kDoubleFilm = 1e-10;  // of the polygon's extent

// Outside of these, squares of areas overflow or vanish; the polygon is scaled by a power of two first.
constexpr double kLargestPlain = 1e70, kSmallestPlain = 1e-70;

double largestCoordinate(std::span<const glm::dvec3> corners) {
  double largest = 0;
  for (const glm::dvec3& p : corners) largest = std::max({largest, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  return largest;
}

// The corners relative to the first one, with coordinates that can be multiplied.
std::vector<glm::dvec3> scaled(std::span<const glm::dvec3> corners, double largest) {
  const int exponent = std::ilogb(largest) + 1;
  std::vector<glm::dvec3> result;
  result.reserve(corners.size());
  for (const glm::dvec3& p : corners) {
    result.emplace_back(std::ldexp(p.x, -exponent), std::ldexp(p.y, -exponent), std::ldexp(p.z, -exponent));
  }
  return result;
}

// Twice the area vector of a closed polygon (Newell).
glm::dvec3 areaVector(std::span<const glm::dvec3> corners) {
  glm::dvec3 sum(0);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    sum += glm::cross(corners[i] - corners[0], corners[i + 1] - corners[0]);
  }
  return sum;
}

bool isPlanar(std::span<const glm::dvec3> corners, const glm::dvec3& normal, double largest, bool singlePrecision) {
  double lowest = 0, highest = 0, extent = 0;
  for (const glm::dvec3& p : corners) {
    const glm::dvec3 offset = p - corners[0];
    const double height = glm::dot(offset, normal);
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
    extent = std::max({extent, std::abs(offset.x), std::abs(offset.y), std::abs(offset.z)});
  }
  const double rounding = singlePrecision ? kFloatRounding * largest : kDoubleRounding * largest + kDoubleFilm * extent;
  return (highest - lowest) / 2 <= rounding;
}

double cross(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

}  // namespace

PolygonCutter::Result PolygonCutter::cut(std::span<const glm::dvec3> corners, bool singlePrecision) {
  triangles_.clear();
  double largest = largestCoordinate(corners);
  std::vector<glm::dvec3> moved;
  if (largest > kLargestPlain || (largest < kSmallestPlain && largest > 0)) {
    moved = scaled(corners, largest);
    corners = moved;
    largest = 1;
  }
  const glm::dvec3 area = areaVector(corners);
  const double length = glm::length(area);
  // Without area there is no plane to speak of; every triangle stands for itself.
  if (!(length > 0)) {
    points_.assign(corners.size(), glm::dvec2(0));
    fan(0);
    return Result::NotPlanar;
  }
  const glm::dvec3 normal = area / length;
  project(corners, normal);
  if (isStrictlyConvex()) {
    fan(0);
  } else if (!clipEars()) {
    triangles_.clear();
    return Result::TooComplex;
  }
  return isPlanar(corners, normal, largest, singlePrecision) ? Result::Planar : Result::NotPlanar;
}

// Drops the axis that the normal points along most; the other two are ordered so that the polygon stays counter-clockwise.
void PolygonCutter::project(std::span<const glm::dvec3> corners, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  int u = (axis + 1) % 3, v = (axis + 2) % 3;
  if (normal[axis] < 0) std::swap(u, v);
  points_.clear();
  for (const glm::dvec3& p : corners) points_.emplace_back(p[u], p[v]);
}

// Left turns all along, and seen from the first corner the others in angular order: then it winds around once.
bool PolygonCutter::isStrictlyConvex() const {
  const std::size_t count = points_.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (!(cross(points_[i], points_[(i + 1) % count], points_[(i + 2) % count]) > 0)) return false;
    if (i > 0 && i + 1 < count && !(cross(points_[0], points_[i], points_[i + 1]) > 0)) return false;
  }
  return true;
}

void PolygonCutter::fan(std::uint32_t apex) {
  const auto count = static_cast<std::uint32_t>(points_.size());
  for (std::uint32_t i = 1; i + 1 < count; ++i)
    triangles_.emplace_back(apex, (apex + i) % count, (apex + i + 1) % count);
}

double PolygonCutter::turn(std::uint32_t corner) const {
  return cross(points_[previous_[corner]], points_[corner], points_[next_[corner]]);
}

// False when the work is spent.
bool PolygonCutter::clipEars() {
  const auto count = static_cast<std::uint32_t>(points_.size());
  previous_.resize(count);
  next_.resize(count);
  clipped_.assign(count, 0);
  for (std::uint32_t i = 0; i < count; ++i) {
    previous_[i] = (i + count - 1) % count;
    next_[i] = (i + 1) % count;
  }
  std::vector<std::uint32_t> reflex;
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!(turn(i) > 0)) reflex.push_back(i);
  }
  reflex_.build(points_, reflex);
  std::uint32_t left = count, corner = 0, refused = 0;
  while (left > 3 && workLeft_ > count) {
    --workLeft_;
    // After a round without an ear, a corner on a straight line may go; after another one, the polygon crosses itself: any cut of the rest will do.
    if (refused >= 2 * left) return fanRing(corner), true;
    const bool take = refused < left ? isEar(corner) : turn(corner) == 0;
    const std::uint32_t following = next_[corner];
    refused = take ? 0 : refused + 1;
    if (take) {
      clip(corner);
      --left;
    }
    // Passing over the neighbour of a clipped ear spreads the cuts and avoids slivers.
    corner = take && left > 3 ? next_[following] : following;
  }
  if (left > 3) return false;
  fanRing(corner);
  return true;
}

void PolygonCutter::fanRing(std::uint32_t apex) {
  for (std::uint32_t i = next_[apex]; next_[i] != apex; i = next_[i]) triangles_.emplace_back(apex, i, next_[i]);
}

// No reflex corner in the closed triangle, other than at the triangle's own corners (as keyholes have them).
bool PolygonCutter::isEar(std::uint32_t corner) {
  const glm::dvec2 a = points_[previous_[corner]], b = points_[corner], c = points_[next_[corner]];
  if (!(cross(a, b, c) > 0)) return false;
  const glm::dvec2 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
  return !reflex_.any(low, high, [&](std::uint32_t other) {
    workLeft_ -= workLeft_ > 0;
    const glm::dvec2 p = points_[other];
    if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y || p == a || p == b || p == c) return false;
    if (cross(a, b, p) < 0 || cross(b, c, p) < 0 || cross(c, a, p) < 0) return false;
    // Clipping takes corners away and makes others convex: neither can be in the way any more.
    return !clipped_[other] && !(turn(other) > 0);
  });
}

void PolygonCutter::clip(std::uint32_t corner) {
  const std::uint32_t before = previous_[corner], after = next_[corner];
  triangles_.emplace_back(before, corner, after);
  clipped_[corner] = 1;
  next_[before] = after;
  previous_[after] = before;
}

}  // namespace copeel
