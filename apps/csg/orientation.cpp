#include "apps/csg/orientation.h"

#include <cmath>

namespace copeel::csg {
namespace {

// (3 + 16 ε) ε: the bound of Shewchuk's first filter for a 2 × 2 determinant of differences.
constexpr double kOrientationBound = 3.3306690738754716e-16;

double orientationExact(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  using Wide = __float128;
  const Wide determinant = (Wide(a.x) - c.x) * (Wide(b.y) - c.y) - (Wide(a.y) - c.y) * (Wide(b.x) - c.x);
  return determinant > 0 ? 1.0 : determinant < 0 ? -1.0 : 0.0;
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
