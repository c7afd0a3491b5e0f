// Included once per SIMD target by edges.cpp; no include guard but Highway's.
#if defined(COPEEL_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_EDGES_INL_H_
#undef COPEEL_EDGES_INL_H_
#else
#define COPEEL_EDGES_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/edges.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Exact = hn::CappedTag<double, 8>;   // whole numbers held in doubles
using Whole = hn::Rebind<std::int32_t, Exact>;
using Lanes = hn::Vec<Exact>;

struct Corner {
  Lanes x, y;
};

struct Bounds {
  Lanes x0, y0, x1, y1;
};

HWY_INLINE HWY_ATTR Corner corner(const std::int32_t* x, const std::int32_t* y) {
  const Exact d;
  const Whole whole;
  return {hn::PromoteTo(d, hn::Load(whole, x)), hn::PromoteTo(d, hn::Load(whole, y))};
}

// Samples have whole-pixel coordinates: the first at or after the smallest corner, the last at or before the largest.
HWY_INLINE HWY_ATTR Bounds boundsOf(const Corner& p, const Corner& q, const Corner& r, const TileFrame& tile) {
  const Exact d;
  const Lanes pixels = hn::Set(d, 1.0 / (1 << tile.bits)), x = hn::Set(d, tile.x0), y = hn::Set(d, tile.y0);
  const auto first = [&](Lanes u, Lanes v, Lanes w, Lanes origin) HWY_ATTR {
    return hn::Max(hn::Sub(hn::Ceil(hn::Mul(hn::Min(hn::Min(u, v), w), pixels)), origin), hn::Zero(d));
  };
  const auto last = [&](Lanes u, Lanes v, Lanes w, Lanes origin, int size) HWY_ATTR {
    return hn::Min(hn::Sub(hn::Floor(hn::Mul(hn::Max(hn::Max(u, v), w), pixels)), origin), hn::Set(d, size - 1));
  };
  return {first(p.x, q.x, r.x, x), first(p.y, q.y, r.y, y), last(p.x, q.x, r.x, x, tile.width), last(p.y, q.y, r.y, y, tile.height)};
}

// Stores edge `from`, `to` of the triangles at `i`; true lanes: it does not hold all of the bounds on its outer side.
HWY_INLINE HWY_ATTR hn::Mask<Exact> setUpEdge(const Corner& from, const Corner& to, const Bounds& bounds, const TileFrame& tile,
                                              std::int32_t* outA, std::int32_t* outB, std::int32_t* outC) {
  const Exact d;
  const Whole whole;
  const Lanes zero = hn::Zero(d), a = hn::Sub(from.y, to.y), b = hn::Sub(to.x, from.x);
  const Lanes originX = hn::Set(d, static_cast<double>(tile.x0 << tile.bits)), originY = hn::Set(d, static_cast<double>(tile.y0 << tile.bits));

  // The top-left rule: a sample on an edge belongs to one side only.
  const auto owns = hn::Or(hn::Gt(a, zero), hn::And(hn::Eq(a, zero), hn::Gt(b, zero)));
  const Lanes atOrigin = hn::Add(hn::Mul(a, hn::Sub(originX, from.x)), hn::Mul(b, hn::Sub(originY, from.y)));
  const Lanes ruled = hn::Sub(atOrigin, hn::IfThenZeroElse(owns, hn::Set(d, 1)));

  // Edge functions at samples are whole numbers of 2^bits plus a constant: their floor has the same sign.
  const Lanes c = hn::Floor(hn::Mul(ruled, hn::Set(d, 1.0 / (1 << tile.bits))));
  const Lanes ax0 = hn::Mul(a, bounds.x0), ax1 = hn::Mul(a, bounds.x1), by0 = hn::Mul(b, bounds.y0), by1 = hn::Mul(b, bounds.y1);
  const Lanes largest = hn::Add(c, hn::Add(hn::Max(ax0, ax1), hn::Max(by0, by1)));
  const Lanes smallest = hn::Add(c, hn::Add(hn::Min(ax0, ax1), hn::Min(by0, by1)));
  const auto needed = hn::Lt(smallest, zero);
  hn::Store(hn::DemoteTo(whole, hn::IfThenElseZero(needed, a)), whole, outA);
  hn::Store(hn::DemoteTo(whole, hn::IfThenElseZero(needed, b)), whole, outB);
  hn::Store(hn::DemoteTo(whole, hn::IfThenElseZero(needed, c)), whole, outC);
  return hn::Ge(largest, zero);
}

using Samples = hn::CappedTag<std::int32_t, 8>;

// Edge functions of sample (x0, y0) of the triangles at `i`, and the steps to the next one.
struct EdgeWalk {
  hn::Vec<Samples> e, a, b;

  HWY_INLINE HWY_ATTR EdgeWalk(const EdgeBatch& batch, int edge, int i) {
    const Samples d;
    a = hn::Load(d, batch.a[edge] + i), b = hn::Load(d, batch.b[edge] + i);
    e = hn::Add(hn::Load(d, batch.c[edge] + i), hn::Add(hn::Mul(a, hn::Load(d, batch.x0 + i)), hn::Mul(b, hn::Load(d, batch.y0 + i))));
  }
};

// The bit of a sample where it is outside.
template <int kBit>
HWY_INLINE HWY_ATTR void addSample(const EdgeWalk& u, const EdgeWalk& v, const EdgeWalk& w, hn::Vec<Samples>& outside) {
  const hn::RebindToUnsigned<Samples> bits;
  const auto sign = hn::ShiftRight<31>(hn::BitCast(bits, hn::Or(hn::Or(u.e, v.e), w.e)));
  outside = hn::Or(outside, hn::BitCast(Samples(), hn::ShiftLeft<kBit>(sign)));
}

template <int kRow>
HWY_INLINE HWY_ATTR void addRow(EdgeWalk u, EdgeWalk v, EdgeWalk w, hn::Vec<Samples>& outside) {
  const auto step = [](EdgeWalk& walk) HWY_ATTR { walk.e = hn::Add(walk.e, walk.a); };
  addSample<8 * kRow>(u, v, w, outside);
  step(u), step(v), step(w);
  addSample<8 * kRow + 1>(u, v, w, outside);
  step(u), step(v), step(w);
  addSample<8 * kRow + 2>(u, v, w, outside);
  step(u), step(v), step(w);
  addSample<8 * kRow + 3>(u, v, w, outside);
}

HWY_INLINE HWY_ATTR void coverLanes(EdgeBatch& batch, int i) {
  const Samples d;
  EdgeWalk u(batch, 0, i), v(batch, 1, i), w(batch, 2, i);
  auto outside = hn::Zero(d);
  const auto down = [](EdgeWalk& walk) HWY_ATTR { walk.e = hn::Add(walk.e, walk.b); };
  addRow<0>(u, v, w, outside);
  down(u), down(v), down(w);
  addRow<1>(u, v, w, outside);
  down(u), down(v), down(w);
  addRow<2>(u, v, w, outside);
  down(u), down(v), down(w);
  addRow<3>(u, v, w, outside);
  hn::Store(hn::Not(outside), d, batch.covered + i);
}

// Bits of 4×4 samples of which some columns or rows are within bounds.
inline constexpr std::uint32_t kColumns[] = {0, 0x01010101, 0x03030303, 0x07070707, 0x0F0F0F0F}, kRows[] = {0, 0xF, 0xF0F, 0xF0F0F, 0xF0F0F0F};

// What small triangles cover. One that covers nothing is no triangle.
HWY_INLINE HWY_ATTR void coverSmall(EdgeBatch& batch, int count) {
  for (int i = 0; i < count; i += static_cast<int>(hn::Lanes(Samples()))) coverLanes(batch, i);
  for (int i = 0; i < count; ++i) {
    const int width = batch.x1[i] - batch.x0[i] + 1, height = batch.y1[i] - batch.y0[i] + 1;
    if (batch.side[i] == 0 || width > 4 || height > 4) {
      batch.covered[i] = 0;
      continue;
    }
    batch.covered[i] &= static_cast<std::int32_t>(kColumns[width] & kRows[height]);
    batch.samples[i] = __builtin_popcount(static_cast<unsigned>(batch.covered[i]));
    if (batch.covered[i] == 0) batch.side[i] = 0;
  }
}

HWY_ATTR void SetUpEdges(EdgeBatch& batch, int count, const TileFrame& tile) {
  const Exact d;
  const Whole whole;
  const Lanes zero = hn::Zero(d);
  const int lanes = static_cast<int>(hn::Lanes(d));
  for (int i = 0; i < count; i += lanes) {
    const Corner p = corner(batch.px + i, batch.py + i), second = corner(batch.qx + i, batch.qy + i), third = corner(batch.rx + i, batch.ry + i);
    const Lanes area = hn::Sub(hn::Mul(hn::Sub(second.x, p.x), hn::Sub(third.y, p.y)), hn::Mul(hn::Sub(second.y, p.y), hn::Sub(third.x, p.x)));
    const Bounds bounds = boundsOf(p, second, third, tile);
    hn::Store(hn::DemoteTo(whole, bounds.x0), whole, batch.x0 + i);
    hn::Store(hn::DemoteTo(whole, bounds.y0), whole, batch.y0 + i);
    hn::Store(hn::DemoteTo(whole, bounds.x1), whole, batch.x1 + i);
    hn::Store(hn::DemoteTo(whole, bounds.y1), whole, batch.y1 + i);

    // Its area, but no more than half of the bounds.
    const Lanes half = hn::Set(d, 0.5), one = hn::Set(d, 1);
    const Lanes width = hn::Add(hn::Sub(bounds.x1, bounds.x0), one), height = hn::Add(hn::Sub(bounds.y1, bounds.y0), one);
    const Lanes pixels = hn::Mul(hn::Abs(area), hn::Set(d, 0.5 / (std::int64_t{1} << (2 * tile.bits))));
    const Lanes samples = hn::Min(pixels, hn::Mul(half, hn::Mul(width, height)));
    hn::Store(hn::DemoteTo(whole, hn::Ceil(samples)), whole, batch.samples + i);

    // Turned alike, the inner side of every edge is the positive one.
    const auto front = hn::Lt(area, zero);
    const Corner q{hn::IfThenElse(front, third.x, second.x), hn::IfThenElse(front, third.y, second.y)};
    const Corner r{hn::IfThenElse(front, second.x, third.x), hn::IfThenElse(front, second.y, third.y)};
    const auto holds = hn::And(hn::And(hn::Ne(area, zero), hn::Le(bounds.x0, bounds.x1)), hn::Le(bounds.y0, bounds.y1));
    const auto pq = setUpEdge(p, q, bounds, tile, batch.a[0] + i, batch.b[0] + i, batch.c[0] + i);
    const auto qr = setUpEdge(q, r, bounds, tile, batch.a[1] + i, batch.b[1] + i, batch.c[1] + i);
    const auto rp = setUpEdge(r, p, bounds, tile, batch.a[2] + i, batch.b[2] + i, batch.c[2] + i);
    const Lanes side = hn::IfThenElse(front, one, hn::Neg(one));
    hn::Store(hn::DemoteTo(whole, hn::IfThenElseZero(hn::And(hn::And(holds, pq), hn::And(qr, rp)), side)), whole, batch.side + i);
  }
  coverSmall(batch, count);
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
