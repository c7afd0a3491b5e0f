// Rational arithmetic by GMP (mpq_class): every double is a rational, so nothing is rounded on the way.
#include "core/coplanarity/exact_order.h"

#include <array>

#include <gmpxx.h>

namespace copeel {
namespace {

using Vector = std::array<mpq_class, 3>;

Vector exact(const glm::dvec3& v) { return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)}; }
Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
mpq_class dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// The exact order value of a class at a sample, held to the class's range. An edge-on plane has none: the middle of its range stands for it,
// as in its approximation.
mpq_class orderValue(const Scene& scene, const PlaneClass& planeClass, const DepthPlane& depth, const View& view, double u, double v) {
  const glm::uvec3 t = scene.objects()[planeClass.object].mesh->triangles[planeClass.triangle];
  const Vector p = exact(scene.worldVertex(planeClass.object, t.x));
  const Vector n = cross(difference(exact(scene.worldVertex(planeClass.object, t.y)), p),
                         difference(exact(scene.worldVertex(planeClass.object, t.z)), p));
  const Vector fromEye = difference(p, exact(view.eye));
  const mpq_class across = dot(n, exact(view.right)) * mpq_class(u) + dot(n, exact(view.down)) * mpq_class(v);
  const mpq_class forward = dot(n, exact(view.forward)), point = dot(n, fromEye);
  const mpq_class denominator = view.perspective ? point : forward;
  const mpq_class lo(double(depth.lo)), hi(double(depth.hi));
  if (denominator == 0) return (lo + hi) / 2;
  const mpq_class numerator = view.perspective ? mpq_class(-(forward + across)) : mpq_class(point - across);
  const mpq_class s = numerator / denominator;
  return s < lo ? lo : s > hi ? hi : s;
}

}  // namespace

int ExactOrder::compare(std::uint32_t p, std::uint32_t q, int x, int y) const {
  if (p == q) return 0;
  const double u = x + 0.5 + view_.offset.x - view_.width * 0.5;
  const double v = y + 0.5 + view_.offset.y - view_.height * 0.5;
  const auto classes = planes_.classes();
  const int order = cmp(orderValue(scene_, classes[p], depths_[p], view_, u, v), orderValue(scene_, classes[q], depths_[q], view_, u, v));
  return (order > 0) - (order < 0);
}

}  // namespace copeel
