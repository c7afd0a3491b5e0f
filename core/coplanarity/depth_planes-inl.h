// Affine depth functions with a running error bound (Higham, Accuracy and Stability of Numerical Algorithms, section 3.3, kept simple:
// every sum of k products is charged k+1 roundings of the sum of magnitudes).
//
// Included once per SIMD target by depth_planes.cpp; no include guard but Highway's for what differs from target to target.
#ifndef COPEEL_DEPTH_VIEW_
#define COPEEL_DEPTH_VIEW_

#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/coplanarity/depth_planes.h"

namespace copeel {

struct DepthView {
  const View& view;
  double nearest;
  double halfWidth, halfHeight;   // largest |u|, |v|
  double right, down;             // lengths
};

// The first vertex of each representative of a group, and where it lies. Points of one object, as nearly all are, are left for a vector to place.
struct GroupPoints {
  alignas(64) double at[3][PlaneClassGroup::kSize] = {};
  glm::dmat4 worldFromPoint{1.0};

  void read(const Scene& scene, const PlaneClassGroup& group, std::size_t count) {
    const std::uint32_t first = group.object[0];
    bool isOne = true;
    for (std::size_t i = 0; i < count; ++i) isOne &= group.object[i] == first;
    const Object& object = scene.objects()[first];
    const Mesh& mesh = *object.mesh;
    worldFromPoint = isOne ? object.worldFromObject : glm::dmat4(1.0);
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 p = isOne ? mesh.vertices[mesh.triangles[group.triangle[i]].x] : pointOf(scene, group.get(i));
      for (int k = 0; k < 3; ++k) at[k][i] = p[k];
    }
  }
};

struct PlaneBatch {
  alignas(64) double a[PlaneClassGroup::kSize], b[PlaneClassGroup::kSize], c[PlaneClassGroup::kSize];
  alignas(64) float lo[PlaneClassGroup::kSize], hi[PlaneClassGroup::kSize], error[PlaneClassGroup::kSize];
};

}  // namespace copeel

#endif

#if defined(COPEEL_DEPTH_PLANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_DEPTH_PLANES_INL_H_
#undef COPEEL_DEPTH_PLANES_INL_H_
#else
#define COPEEL_DEPTH_PLANES_INL_H_
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace copeel {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::CappedTag<double, PlaneClassGroup::kSize>;
using F32 = hn::Rebind<float, F64>;
using V = hn::Vec<F64>;

inline constexpr double kEps = std::numeric_limits<double>::epsilon();

HWY_INLINE HWY_ATTR V all(double value) { return hn::Set(F64(), value); }

struct V3 {
  V x, y, z;
};

HWY_INLINE HWY_ATTR V3 load3(const double (&from)[3][PlaneClassGroup::kSize], std::size_t i) {
  const F64 d;
  return {hn::LoadU(d, from[0] + i), hn::LoadU(d, from[1] + i), hn::LoadU(d, from[2] + i)};
}

HWY_INLINE HWY_ATTR V3 promote3(const float (&from)[3][PlaneClassGroup::kSize], std::size_t i) {
  const F64 d;
  const F32 f;
  return {hn::PromoteTo(d, hn::LoadU(f, from[0] + i)), hn::PromoteTo(d, hn::LoadU(f, from[1] + i)), hn::PromoteTo(d, hn::LoadU(f, from[2] + i))};
}

HWY_INLINE HWY_ATTR V dot(const V3& a, const glm::dvec3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, all(b.x)), hn::Mul(a.y, all(b.y))), hn::Mul(a.z, all(b.z)));
}
// transformPoint.
HWY_INLINE HWY_ATTR V3 transformed(const glm::dmat4& m, const V3& p) {
  const auto row = [&](int i) HWY_ATTR {
    return hn::Add(hn::Add(hn::Add(hn::Mul(all(m[0][i]), p.x), hn::Mul(all(m[1][i]), p.y)), hn::Mul(all(m[2][i]), p.z)), all(m[3][i]));
  };
  return {row(0), row(1), row(2)};
}

HWY_INLINE HWY_ATTR V dot(const V3& a, const V3& b) { return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z)); }

// The next float after a rounded value: floats of one sign are ordered as their bits.
HWY_INLINE HWY_ATTR hn::Vec<F32> above(V value) {
  const F32 f;
  const hn::RebindToSigned<F32> bits;
  constexpr float kInf = std::numeric_limits<float>::infinity();
  const auto rounded = hn::DemoteTo(f, value);
  const auto step = hn::IfThenElse(hn::RebindMask(bits, hn::Gt(rounded, hn::Zero(f))), hn::Set(bits, 1), hn::Set(bits, -1));
  const auto next = hn::BitCast(f, hn::Add(hn::BitCast(bits, rounded), step));
  const auto finite = hn::IfThenElse(hn::Eq(rounded, hn::Zero(f)), hn::Set(f, std::numeric_limits<float>::denorm_min()), next);
  const auto other = hn::IfThenElse(hn::Eq(rounded, hn::Set(f, -kInf)), hn::Set(f, std::numeric_limits<float>::lowest()), rounded);
  return hn::IfThenElse(hn::Lt(hn::Abs(rounded), hn::Set(f, kInf)), finite, other);
}
HWY_INLINE HWY_ATTR hn::Vec<F32> below(V value) { return hn::Neg(above(hn::Neg(value))); }

// The depths that the class's faces reach.
HWY_INLINE HWY_ATTR void setRange(const PlaneClassGroup& from, std::size_t i, const DepthView& setup, PlaneBatch& out) {
  const F32 f;
  const V3 lower = promote3(from.boundsMin, i), upper = promote3(from.boundsMax, i);
  const auto middle = [&](V l, V u, double eye) HWY_ATTR { return hn::Sub(hn::Mul(hn::Add(l, u), all(0.5)), all(eye)); };
  const auto half = [&](V l, V u) HWY_ATTR { return hn::Mul(hn::Sub(u, l), all(0.5)); };
  const glm::dvec3 forward = setup.view.forward, eye = setup.view.eye, size = glm::abs(forward);
  const V t = dot(V3{middle(lower.x, upper.x, eye.x), middle(lower.y, upper.y, eye.y), middle(lower.z, upper.z, eye.z)}, forward);
  const V reach = hn::Mul(dot(V3{half(lower.x, upper.x), half(lower.y, upper.y), half(lower.z, upper.z)}, size), all(1 + 8 * kEps));
  V least = hn::Sub(t, reach), most = hn::Add(t, reach);
  if (setup.view.perspective) {
    least = hn::Div(all(-1), hn::Max(least, all(setup.nearest)));
    most = hn::Div(all(-1), hn::Max(most, all(setup.nearest)));
  }
  hn::Store(below(least), f, out.lo + i);
  hn::Store(above(most), f, out.hi + i);
}

// s = numerator / denominator; the errors of both bound the error of s.
HWY_INLINE HWY_ATTR void setPlanes(const PlaneClassGroup& from, const GroupPoints& points, std::size_t i, const DepthView& setup, PlaneBatch& out) {
  const F64 d;
  const F32 f;
  const View& view = setup.view;
  const V lo = hn::PromoteTo(d, hn::Load(f, out.lo + i)), hi = hn::PromoteTo(d, hn::Load(f, out.hi + i));
  const V3 n = load3(from.normal, i), point = transformed(points.worldFromPoint, load3(points.at, i));
  const V3 p{hn::Sub(point.x, all(view.eye.x)), hn::Sub(point.y, all(view.eye.y)), hn::Sub(point.z, all(view.eye.z))};
  const V alongPoint = dot(n, p), alongForward = dot(n, view.forward);
  const V unit = hn::Add(hn::PromoteTo(d, hn::LoadU(f, from.normalError + i)), all(8 * kEps));   // error of a dot product with n, per length of the other vector
  const V pointError = hn::Mul(unit, hn::Sqrt(dot(p, p)));
  const V denominator = view.perspective ? alongPoint : alongForward;
  const V denominatorError = view.perspective ? pointError : unit;
  const V constant = view.perspective ? alongForward : alongPoint;
  const V rays = hn::Mul(unit, all(setup.halfWidth * setup.right + setup.halfHeight * setup.down));
  const V numeratorError = hn::Add(rays, view.perspective ? unit : pointError);
  const V a = hn::Div(hn::Neg(dot(n, view.right)), denominator), b = hn::Div(hn::Neg(dot(n, view.down)), denominator);
  const V c = hn::Div(hn::Mul(all(view.perspective ? -1 : 1), constant), denominator);
  const V largest = hn::Max(hn::Abs(lo), hn::Abs(hi));
  const V sum = hn::Add(hn::Add(hn::Mul(hn::Abs(a), all(setup.halfWidth)), hn::Mul(hn::Abs(b), all(setup.halfHeight))), hn::Abs(c));
  const V evaluation = hn::Mul(all(8 * kEps), sum);
  const V propagated = hn::Div(hn::Mul(all(2), hn::Add(numeratorError, hn::Mul(largest, denominatorError))), hn::Abs(denominator));
  // The plane may hold the eye: nothing is known but the range.
  const auto known = hn::Gt(hn::Abs(denominator), hn::Mul(all(4), denominatorError));
  hn::Store(hn::IfThenElseZero(known, a), d, out.a + i);
  hn::Store(hn::IfThenElseZero(known, b), d, out.b + i);
  hn::Store(hn::IfThenElse(known, c, hn::Mul(all(0.5), hn::Add(lo, hi))), d, out.c + i);
  hn::Store(above(hn::IfThenElse(known, hn::Add(evaluation, propagated), all(std::numeric_limits<double>::infinity()))), f, out.error + i);
}

HWY_ATTR void SetDepthPlanes(const Scene& scene, const PlaneClassGroup* groups, std::size_t count, const DepthView& setup, DepthPlane* out) {
  GroupPoints points;
  PlaneBatch planes;
  for (std::size_t begin = 0; begin < count; begin += PlaneClassGroup::kSize, ++groups) {
    const std::size_t size = count - begin < PlaneClassGroup::kSize ? count - begin : PlaneClassGroup::kSize;
    points.read(scene, *groups, size);
    for (std::size_t i = 0; i < size; i += hn::Lanes(F64())) setRange(*groups, i, setup, planes);
    for (std::size_t i = 0; i < size; i += hn::Lanes(F64())) setPlanes(*groups, points, i, setup, planes);
    for (std::size_t i = 0; i < size; ++i) out[begin + i] = {planes.a[i], planes.b[i], planes.c[i], planes.lo[i], planes.hi[i], planes.error[i]};
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel
HWY_AFTER_NAMESPACE();

#endif
