// Filtered predicates. Based on: Shewchuk. Adaptive precision floating-point arithmetic and fast robust geometric predicates. Discrete &
// Computational Geometry 18, 1997.
#include "apps/csg/orientation.h"

#include <gmpxx.h>

#include <cmath>

namespace copeel::csg {
namespace {

// (3 + 16 ε) ε: the bound of the first filter for a 2 × 2 determinant of differences.
constexpr double kOrientationBound = 3.3306690738754716e-16;

// The rounding error of a − b is a double again (Knuth); infinite or NaN where the difference overflows.
double roundingOfDifference(double a, double b) {
  const double difference = a - b, partOfB = a - difference, partOfA = difference + partOfB;
  return (a - partOfA) + (partOfB - b);
}

// Where the differences are doubles, as on any grid, their products fit 113 bits; rationals otherwise.
double orientationExact(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const bool areDoubles = roundingOfDifference(a.x, c.x) == 0 && roundingOfDifference(b.y, c.y) == 0 &&
                          roundingOfDifference(a.y, c.y) == 0 && roundingOfDifference(b.x, c.x) == 0;
  if (areDoubles) {
    using Wide = __float128;
    const Wide left = Wide(a.x - c.x) * (b.y - c.y), right = Wide(a.y - c.y) * (b.x - c.x);
    return left > right ? 1.0 : left < right ? -1.0 : 0.0;
  }
  const mpq_class cx(c.x), cy(c.y);
  const mpq_class left = (a.x - cx) * (b.y - cy), right = (a.y - cy) * (b.x - cx);
  return cmp(left, right);
}

}  // namespace

double orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  if (std::abs(determinant) > kOrientationBound * (std::abs(left) + std::abs(right))) return determinant;
  return orientationExact(a, b, c);
}

// Not exact: it chooses shapes, not topology.
double inCircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const glm::dvec2 p = a - d, q = b - d, r = c - d;
  const auto square = [](const glm::dvec2& v) { return v.x * v.x + v.y * v.y; };
  const double first = square(p) * (q.x * r.y - q.y * r.x);
  const double second = square(q) * (r.x * p.y - r.y * p.x);
  const double third = square(r) * (p.x * q.y - p.y * q.x);
  const double sum = first + second + third;
  // What rounding may have made counts as on the circle, so that a flip is never undone.
  return std::abs(sum) > 1e-14 * (std::abs(first) + std::abs(second) + std::abs(third)) ? sum : 0.0;
}
bool isConvexLoop(std::span<const glm::dvec2> points) {
  const std::size_t n = points.size();
  if (n < 3) return false;
  // Once around means that the direction turns from rising to falling in x once only.
  std::size_t changes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 &a = points[i], &b = points[(i + 1) % n], &c = points[(i + 2) % n];
    if (!(orientation(a, b, c) > 0)) return false;
    if ((a.x < b.x || (a.x == b.x && a.y < b.y)) != (b.x < c.x || (b.x == c.x && b.y < c.y))) ++changes;
  }
  return changes == 2;
}

}  // namespace copeel::csg
