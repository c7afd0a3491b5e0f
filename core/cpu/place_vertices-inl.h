// Included once per SIMD target by place_vertices.cpp; no include guard but Highway's.
#if defined(COPEEL_PLACE_VERTICES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_PLACE_VERTICES_INL_H_
#undef COPEEL_PLACE_VERTICES_INL_H_
#else
#define COPEEL_PLACE_VERTICES_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/place_vertices.h"
#include "core/cpu/projection.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

inline constexpr std::size_t kBatch = 8;

using F64 = hn::CappedTag<double, kBatch>;
using I32 = hn::Rebind<std::int32_t, F64>;
using V = hn::Vec<F64>;

struct V3 {
  V x, y, z;
};

HWY_INLINE HWY_ATTR V all(double value) { return hn::Set(F64(), value); }

// glm::dot's order.
HWY_INLINE HWY_ATTR V dot(const glm::dvec3& a, const V3& b) {
  return hn::Add(hn::Add(hn::Mul(all(a.x), b.x), hn::Mul(all(a.y), b.y)), hn::Mul(all(a.z), b.z));
}

// A row of transformPoint.
HWY_INLINE HWY_ATTR V transformed(const glm::dmat4& m, int row, const V3& p) {
  return hn::Add(hn::Add(hn::Add(hn::Mul(all(m[0][row]), p.x), hn::Mul(all(m[1][row]), p.y)), hn::Mul(all(m[2][row]), p.z)), all(m[3][row]));
}

// Grid coordinates of vertices at `x`, `y` and `z`; true: some lie behind.
HWY_INLINE HWY_ATTR bool placeLanes(const Placement& to, const V3& p, std::int32_t* outX, std::int32_t* outY) {
  const F64 d;
  const I32 whole;
  const V3 fromEye{hn::Sub(transformed(to.worldFromObject, 0, p), all(to.eye.x)), hn::Sub(transformed(to.worldFromObject, 1, p), all(to.eye.y)),
                   hn::Sub(transformed(to.worldFromObject, 2, p), all(to.eye.z))};
  const V z = dot(to.forward, fromEye), w = to.perspective ? z : all(1);
  const V u = hn::Div(dot(to.right, fromEye), w), v = hn::Div(dot(to.down, fromEye), w);
  const auto ahead = to.perspective ? hn::Ge(z, all(to.nearest)) : hn::Eq(w, w);
  const auto fits = hn::And(ahead, hn::And(hn::Le(hn::Abs(u), all(to.limitX)), hn::Le(hn::Abs(v), all(to.limitY))));
  const auto snapped = [&](V at, double origin) HWY_ATTR {
    return hn::DemoteTo(whole, hn::IfThenElseZero(fits, hn::Round(hn::Mul(hn::Sub(at, all(origin)), all(to.scale)))));
  };
  const auto x = hn::IfThenElse(fits, hn::PromoteTo(d, snapped(u, to.originX)), all(kOffGrid));
  hn::Store(hn::DemoteTo(whole, x), whole, outX);
  hn::Store(snapped(v, to.originY), whole, outY);
  return !hn::AllTrue(d, ahead);
}

HWY_ATTR bool PlaceVertices(const Placement& placement, std::span<const glm::dvec3> vertices, glm::ivec2* out) {
  const F64 d;
  alignas(64) double x[kBatch], y[kBatch], z[kBatch];
  alignas(64) std::int32_t gridX[kBatch], gridY[kBatch];
  bool behind = false;
  for (std::size_t begin = 0; begin < vertices.size(); begin += kBatch) {
    // Places that are left over in the last batch hold its last vertex.
    for (std::size_t i = 0; i < kBatch; ++i) {
      const glm::dvec3& vertex = vertices[begin + i < vertices.size() ? begin + i : vertices.size() - 1];
      x[i] = vertex.x, y[i] = vertex.y, z[i] = vertex.z;
    }
    for (std::size_t i = 0; i < kBatch; i += hn::Lanes(d)) {
      behind |= placeLanes(placement, {hn::Load(d, x + i), hn::Load(d, y + i), hn::Load(d, z + i)}, gridX + i, gridY + i);
    }
    for (std::size_t i = 0; i < kBatch && begin + i < vertices.size(); ++i) out[begin + i] = {gridX[i], gridY[i]};
  }
  return behind;
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
