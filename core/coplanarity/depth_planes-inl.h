// Affine depth functions with a running error bound (Higham, Accuracy and Stability of Numerical Algorithms, section 3.3, kept simple:
// every sum of k products is charged k+1 roundings of the sum of magnitudes).
//
// Included once per SIMD target by depth_planes.cpp; no include guard but Highway's for what differs from target to target.
#ifndef COPEEL_DEPTH_VIEW_
#define COPEEL_DEPTH_VIEW_

#include <bit>
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

// The first vertex of each representative of a group, and where it lies. Points of one object, as nearly all are, are left for a vector to place, if
// the object is not where its mesh is.
struct GroupPoints {
  alignas(64) double at[3][PlaneClassGroup::kSize] = {};
  const Object* placed = nullptr;   // the object whose points are still to be placed; null: none

  void read(const Scene& scene, const PlaneClassGroup& group, std::size_t count) {
    const std::uint32_t first = group.object[0];
    bool isOne = true;
    for (std::size_t i = 0; i < count; ++i) isOne &= group.object[i] == first;
    const Object& object = scene.objects()[first];
    if (&object != last_) {
      last_ = &object;
      isWhereItsMeshIs_ = object.worldFromObject == glm::dmat4(1.0);
    }
    placed = isOne && !isWhereItsMeshIs_ ? &object : nullptr;
    const Mesh& mesh = *object.mesh;
    for (std::size_t i = 0; i < count; ++i) {
      const glm::dvec3 p = isOne ? mesh.vertices[mesh.triangles[group.triangle[i]].x] : pointOf(scene, group.get(i));
      for (int k = 0; k < 3; ++k) at[k][i] = p[k];
    }
  }

 private:
  const Object* last_ = nullptr;
  bool isWhereItsMeshIs_ = false;
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
using U64 = hn::RebindToUnsigned<F64>;
using U32 = hn::RebindToUnsigned<F32>;
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

// The lowest four bits of a float are worth 15/16 of 2^-19 of it at most, or 15 of the smallest float.
inline constexpr double kOutward = 1.0 / (1 << 18), kOutwardLeast = 0x1p-140;
inline constexpr double kMostFloat = 0x1.fffep127;   // no bits of it make an infinity: values are held to it

// A float's bits, the lowest four zero, that whatever they become is not above the value, or not below it.
HWY_INLINE HWY_ATTR hn::Vec<U32> bitsOfFloat(V value) {
  const V held = hn::Min(hn::Max(value, all(-kMostFloat)), all(kMostFloat));
  return hn::AndNot(hn::Set(U32(), DepthPlane::kErrorMask), hn::BitCast(U32(), hn::DemoteTo(F32(), held)));
}
HWY_INLINE HWY_ATTR V outward(V value) { return hn::Add(hn::Mul(hn::Abs(value), all(kOutward)), all(kOutwardLeast)); }
HWY_INLINE HWY_ATTR hn::Vec<U32> roundedBelow(V value) { return bitsOfFloat(hn::Sub(value, outward(value))); }
HWY_INLINE HWY_ATTR hn::Vec<U32> roundedAbove(V value) { return bitsOfFloat(hn::Add(value, outward(value))); }

// DepthPlane's, of a bound that may be +inf.
HWY_INLINE HWY_ATTR hn::Vec<U32> exponentOf(V error) {
  const U64 u;
  constexpr double kLeast = 1.0 / (std::uint64_t{1} << 60), kMost = 0x1p75;
  static_assert(DepthPlane::kUnknown - DepthPlane::kErrorBias == 75 && DepthPlane::kErrorBias == 3 * 60);
  const V held = hn::Min(hn::Max(error, all(kLeast * kLeast * kLeast)), all(kMost));
  const auto exponent = hn::ShiftRight<52>(hn::Add(hn::BitCast(u, held), hn::Set(u, (std::uint64_t{1} << 52) - 1)));
  return hn::TruncateTo(U32(), hn::Sub(exponent, hn::Set(u, 1023 - DepthPlane::kErrorBias)));
}

struct Range {
  V least, most;
};

// The depths that the class's faces reach.
HWY_INLINE HWY_ATTR Range rangeOf(const PlaneClassGroup& from, std::size_t i, const DepthView& setup) {
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
  return {least, most};
}

// s = numerator / denominator; the errors of both bound the error of s.
HWY_INLINE HWY_ATTR void setPlanes(const PlaneClassGroup& from, const GroupPoints& points, std::size_t i, const DepthView& setup, DepthPlane* out) {
  const F64 d;
  const F32 f;
  const U64 u;
  const View& view = setup.view;
  const Range range = rangeOf(from, i, setup);
  const V3 n = load3(from.normal, i), read = load3(points.at, i), point = points.placed ? transformed(points.placed->worldFromObject, read) : read;
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
  const V largest = hn::Add(hn::Mul(hn::Max(hn::Abs(range.least), hn::Abs(range.most)), all(1 + 2 * kOutward)), all(2 * kOutwardLeast));
  const V sum = hn::Add(hn::Add(hn::Mul(hn::Abs(a), all(setup.halfWidth)), hn::Mul(hn::Abs(b), all(setup.halfHeight))), hn::Abs(c));
  const V evaluation = hn::Mul(all(8 * kEps), sum);
  const V propagated = hn::Div(hn::Mul(all(2), hn::Add(numeratorError, hn::Mul(largest, denominatorError))), hn::Abs(denominator));
  // The plane may hold the eye: nothing is known but the range.
  const auto known = hn::Gt(hn::Abs(denominator), hn::Mul(all(4), denominatorError));
  const auto exponent = exponentOf(hn::IfThenElse(known, hn::Add(evaluation, propagated), all(std::numeric_limits<double>::infinity())));
  const auto lo = hn::Or(roundedBelow(range.least), hn::ShiftRight<DepthPlane::kErrorBits>(exponent));
  const auto hi = hn::Or(roundedAbove(range.most), hn::And(exponent, hn::Set(U32(), DepthPlane::kErrorMask)));
  const auto both = hn::Or(hn::PromoteTo(u, lo), hn::ShiftLeft<32>(hn::PromoteTo(u, hi)));
  static_assert(offsetof(DepthPlane, lo) == 24 && offsetof(DepthPlane, hi) == 28 && std::endian::native == std::endian::little);
  hn::StoreInterleaved4(hn::IfThenElseZero(known, a), hn::IfThenElseZero(known, b),
                        hn::IfThenElse(known, c, hn::Mul(all(0.5), hn::Add(range.least, range.most))), hn::BitCast(d, both), d, &out[i].a);
}

HWY_ATTR void SetDepthPlanes(const Scene& scene, const PlaneClassGroup* groups, std::size_t count, const DepthView& setup, DepthPlane* out) {
  GroupPoints points;
  DepthPlane last[PlaneClassGroup::kSize];
  for (std::size_t begin = 0; begin < count; begin += PlaneClassGroup::kSize, ++groups) {
    const std::size_t size = count - begin < PlaneClassGroup::kSize ? count - begin : PlaneClassGroup::kSize;
    const bool isWhole = size == PlaneClassGroup::kSize;
    points.read(scene, *groups, size);
    for (std::size_t i = 0; i < size; i += hn::Lanes(F64())) setPlanes(*groups, points, i, setup, isWhole ? out + begin : last);
    if (!isWhole) std::copy_n(last, size, out + begin);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel
HWY_AFTER_NAMESPACE();

#endif
