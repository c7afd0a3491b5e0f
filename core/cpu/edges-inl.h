// Included once per SIMD target by edges.cpp; no include guard but Highway's.
#if defined(COPEEL_EDGES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_EDGES_INL_H_
#undef COPEEL_EDGES_INL_H_
#else
#define COPEEL_EDGES_INL_H_
#endif

#include <bit>
#include <cstddef>
#include <limits>

#include <hwy/highway.h>

#include "core/cpu/edges.h"
#include "core/cpu/lanes-inl.h"

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

HWY_INLINE HWY_ATTR Corner corner(const glm::ivec2* from) {
  const Exact d;
  const Whole whole;
  hn::Vec<Whole> x, y;
  hn::LoadInterleaved2(whole, &from->x, x, y);
  return {hn::PromoteTo(d, x), hn::PromoteTo(d, y)};
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
  addSample<4 * kRow>(u, v, w, outside);
  step(u), step(v), step(w);
  addSample<4 * kRow + 1>(u, v, w, outside);
  step(u), step(v), step(w);
  addSample<4 * kRow + 2>(u, v, w, outside);
  step(u), step(v), step(w);
  addSample<4 * kRow + 3>(u, v, w, outside);
}

// Of the 4×4 samples from each triangle's first one on: bit x + 4·y.
HWY_INLINE HWY_ATTR hn::Vec<Samples> coveredSamples(const EdgeBatch& batch, int i) {
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
  return hn::Not(outside);
}

using Bits = hn::RebindToUnsigned<Samples>;

// So many times as there are samples in a row, four at most: the lowest bits.
template <int kBitsLog>
HWY_INLINE HWY_ATTR hn::Vec<Samples> lowBits(hn::Vec<Samples> count) {
  const Samples d;
  const auto one = hn::Set(d, 1), within = hn::Min(hn::Max(count, one), hn::Set(d, TriangleSetup::kSmall));
  return hn::Sub(hn::Shl(one, hn::ShiftLeft<kBitsLog>(within)), one);
}

// placeOf.
HWY_INLINE HWY_ATTR hn::Vec<Samples> placesOf(hn::Vec<Samples> x, hn::Vec<Samples> y) {
  const Samples d;
  const auto inBlock = hn::Set(d, kBlockSize - 1);
  const auto block = hn::Add(hn::Mul(hn::ShiftRight<3>(y), hn::Set(d, kBlocksPerSide)), hn::ShiftRight<3>(x));
  return hn::Add(hn::ShiftLeft<6>(block), hn::Add(hn::ShiftLeft<3>(hn::And(y, inBlock)), hn::And(x, inBlock)));
}
static_assert(kBlockSize == 8 && kBlockPixels == 64);

// What small triangles cover; slots and setups. A triangle that covers nothing is none.
HWY_INLINE HWY_ATTR void putSetups(EdgeBatch& batch, int i) {
  const Samples d;
  const Bits bits;
  const auto one = hn::Set(d, 1), zero = hn::Zero(d), side = hn::Load(d, batch.side + i);
  const auto x0 = hn::Load(d, batch.x0 + i), y0 = hn::Load(d, batch.y0 + i), x1 = hn::Load(d, batch.x1 + i), y1 = hn::Load(d, batch.y1 + i);
  const auto width = hn::Add(hn::Sub(x1, x0), one), height = hn::Add(hn::Sub(y1, y0), one);
  const auto isSmall = hn::Not(hn::Gt(hn::Max(width, height), hn::Set(d, TriangleSetup::kSmall)));
  // Columns and rows that are within bounds: a bit of each row for a column, then of each row the lowest.
  const auto within = hn::Mul(lowBits<0>(width), hn::And(lowBits<2>(height), hn::Set(d, 0x1111)));
  const auto covered = hn::And(coveredSamples(batch, i), within);
  const auto keptSide = hn::IfThenZeroElse(hn::And(isSmall, hn::Eq(covered, zero)), side);
  const auto isKept = hn::Ne(keptSide, zero);
  hn::Store(keptSide, d, batch.side + i);
  hn::Store(hn::IfThenElseZero(isKept, one), d, reinterpret_cast<std::int32_t*>(batch.isKept + i));
  hn::Store(hn::IfThenElseZero(hn::And(isKept, isSmall), one), d, reinterpret_cast<std::int32_t*>(batch.isSmall + i));
  batch.withEdges |= bitsOf(d, hn::AndNot(isSmall, isKept)) << i;
  const auto count = hn::BitCast(d, hn::PopulationCount(hn::BitCast(bits, covered)));
  hn::Store(hn::IfThenElse(isSmall, count, hn::Load(d, batch.samples + i)), d, batch.samples + i);

  const auto planeClass = hn::Load(bits, batch.planeClass + i);
  const auto bounds = hn::Or(hn::Or(x0, hn::ShiftLeft<8>(y0)), hn::Or(hn::ShiftLeft<16>(x1), hn::ShiftLeft<24>(y1)));
  const auto small = hn::Or(covered, hn::ShiftLeft<16>(placesOf(x0, y0)));
  const auto cover = hn::IfThenElse(isSmall, small, hn::Set(d, static_cast<std::int32_t>(TriangleSetup::kHasEdges)));
  static_assert(offsetof(TriangleSetup, planeClass) == 4 && offsetof(TriangleSetup, cover) == 8);
  hn::StoreInterleaved4(hn::BitCast(bits, bounds), planeClass, hn::BitCast(bits, cover), hn::Zero(bits), bits,
                        reinterpret_cast<std::uint32_t*>(batch.setups + i));
  const auto turned = hn::BitCast(bits, hn::Mul(keptSide, hn::Load(d, batch.turn + i)));
  static_assert(offsetof(TileSlot, planeClass) == 4 && offsetof(TileSlot, object) == 8 && offsetof(TileSlot, side) == 12 && sizeof(TileSlot) == 16);
  hn::StoreInterleaved4(hn::Load(bits, batch.primitive + i), planeClass, hn::Load(bits, batch.object + i), turned, bits,
                        reinterpret_cast<std::uint32_t*>(batch.slots + i));
}

// DepthExtent, lane by lane.
struct Extents {
  Lanes least, most, leastError, mostError, samples;

  HWY_INLINE HWY_ATTR explicit Extents(const DepthExtent& from) {
    const Exact d;
    least = hn::Set(d, from.least), most = hn::Set(d, from.most);
    leastError = hn::Set(d, from.leastError), mostError = hn::Set(d, from.mostError);
    samples = hn::Zero(d);
  }
  HWY_INLINE HWY_ATTR void add(hn::Mask<Exact> which, Lanes from, Lanes to, Lanes error, Lanes count) {
    least = hn::IfThenElse(which, hn::Min(least, from), least), most = hn::IfThenElse(which, hn::Max(most, to), most);
    leastError = hn::IfThenElse(which, hn::Min(leastError, error), leastError), mostError = hn::IfThenElse(which, hn::Max(mostError, error), mostError);
    samples = hn::Add(samples, hn::IfThenElseZero(which, count));
  }
  HWY_INLINE HWY_ATTR void addTo(DepthExtent& to) const {
    const Exact d;
    to.least = hn::GetLane(hn::MinOfLanes(d, least)), to.most = hn::GetLane(hn::MaxOfLanes(d, most));
    to.leastError = hn::GetLane(hn::MinOfLanes(d, leastError)), to.mostError = hn::GetLane(hn::MaxOfLanes(d, mostError));
    to.samples += static_cast<std::int64_t>(hn::GetLane(hn::SumOfLanes(d, samples)));
  }
};

// DepthPlane's lo and hi, side by side in a lane, and what their lowest bits hold.
struct PlaneRange {
  Lanes lo, hi, error;

  HWY_INLINE HWY_ATTR explicit PlaneRange(Lanes pairs) {
    const Exact d;
    const hn::RebindToUnsigned<Exact> u;
    static_assert(std::endian::native == std::endian::little);
    const auto bits = hn::BitCast(u, pairs), upper = hn::ShiftRight<32>(bits), mask = hn::Set(u, DepthPlane::kErrorMask);
    lo = asFloat(bits), hi = asFloat(upper);
    const auto exponent = hn::Or(hn::ShiftLeft<DepthPlane::kErrorBits>(hn::And(bits, mask)), hn::And(upper, mask));
    const auto known = hn::BitCast(d, hn::ShiftLeft<52>(hn::Add(exponent, hn::Set(u, 1023 - DepthPlane::kErrorBias))));
    const auto isUnknown = hn::RebindMask(d, hn::Eq(exponent, hn::Set(u, DepthPlane::kUnknown)));
    error = hn::IfThenElse(isUnknown, hn::Set(d, std::numeric_limits<double>::infinity()), known);
  }

 private:
  static HWY_INLINE HWY_ATTR Lanes asFloat(hn::Vec<hn::RebindToUnsigned<Exact>> bits) {
    const hn::Rebind<std::uint32_t, Exact> half;
    return hn::PromoteTo(Exact(), hn::BitCast(hn::Rebind<float, Exact>(), hn::TruncateTo(half, bits)));
  }
};

// Depths that the planes reach within the bounds: orderAt's operations in its order, so that none of their samples lies beyond.
HWY_INLINE HWY_ATTR void addDepths(const EdgeBatch& batch, int i, const TileFrame& tile, Extents& extents) {
  const Exact d;
  const Whole whole;
  const Corner first = corner(batch.x0 + i, batch.y0 + i), last = corner(batch.x1 + i, batch.y1 + i);
  // Side by side, then field by field.
  constexpr std::size_t kMost = hn::MaxLanes(d);
  alignas(64) double fields[4 * kMost];
  static_assert(offsetof(DepthPlane, c) == 16 && offsetof(DepthPlane, lo) == 24 && offsetof(DepthPlane, hi) == 28);
  const hn::CappedTag<double, 4> fourFields;
#pragma GCC unroll 8
  for (std::size_t k = 0; k < kMost; ++k) {
    const DepthPlane& plane = tile.planes[batch.planeClass[i + k]];
    for (std::size_t field = 0; field < 4; field += hn::Lanes(fourFields)) {
      hn::Store(hn::LoadU(fourFields, &plane.a + field), fourFields, fields + 4 * k + field);
    }
  }
  Lanes a, b, c, pairs;
  hn::LoadInterleaved4(d, fields, a, b, c, pairs);
  const PlaneRange range(pairs);
  const Lanes u = hn::Set(d, tile.u), v = hn::Set(d, tile.v);
  const Lanes left = hn::Mul(a, hn::Add(u, first.x)), right = hn::Mul(a, hn::Add(u, last.x));
  const Lanes top = hn::Mul(b, hn::Add(v, first.y)), bottom = hn::Mul(b, hn::Add(v, last.y));
  const auto clamped = [&](Lanes order) HWY_ATTR { return hn::Min(hn::Max(order, range.lo), range.hi); };
  const Lanes least = clamped(hn::Add(hn::Min(left, right), hn::Add(hn::Min(top, bottom), c)));
  const Lanes most = clamped(hn::Add(hn::Max(left, right), hn::Add(hn::Max(top, bottom), c)));
  const auto isSetUp = hn::Ne(hn::PromoteTo(d, hn::Load(whole, batch.side + i)), hn::Zero(d));
  extents.add(isSetUp, least, most, range.error, hn::PromoteTo(d, hn::Load(whole, batch.samples + i)));
}

// Of any triangles. Their edges and bounds, at as many places from i on as doubles have lanes.
HWY_INLINE HWY_ATTR void setUpAny(EdgeBatch& batch, int i, const TileFrame& tile) {
  const Exact d;
  const Whole whole;
  const Lanes zero = hn::Zero(d);
  const Corner p = corner(batch.p + i), second = corner(batch.q + i), third = corner(batch.r + i);
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

// The largest extent, in grid steps, of triangles whose areas and edge functions fit 32 bits: 2 · kShort² < 2^31.
inline constexpr std::int32_t kShort = (1 << 15) - 1;

struct ShortCorner {
  hn::Vec<Samples> x, y;

  HWY_INLINE HWY_ATTR ShortCorner(hn::Vec<Samples> atX, hn::Vec<Samples> atY) : x(atX), y(atY) {}
  HWY_INLINE HWY_ATTR explicit ShortCorner(const glm::ivec2* from) { hn::LoadInterleaved2(Samples(), &from->x, x, y); }
};

// setUpEdge in whole numbers of 32 bits, at the first sample of the bounds.
HWY_INLINE HWY_ATTR hn::Mask<Samples> setUpShortEdge(EdgeBatch& batch, int edge, int i, const ShortCorner& from, const ShortCorner& to, const TileFrame& tile) {
  const Samples d;
  const auto zero = hn::Zero(d), x0 = hn::Load(d, batch.x0 + i), y0 = hn::Load(d, batch.y0 + i);
  const auto a = hn::Sub(from.y, to.y), b = hn::Sub(to.x, from.x);
  const auto owns = hn::Or(hn::Gt(a, zero), hn::And(hn::Eq(a, zero), hn::Gt(b, zero)));
  const auto across = hn::Sub(hn::ShiftLeftSame(hn::Add(x0, hn::Set(d, tile.x0)), tile.bits), from.x);
  const auto down = hn::Sub(hn::ShiftLeftSame(hn::Add(y0, hn::Set(d, tile.y0)), tile.bits), from.y);
  const auto first = hn::Sub(hn::Add(hn::Mul(a, across), hn::Mul(b, down)), hn::IfThenZeroElse(owns, hn::Set(d, 1)));
  const auto e = hn::ShiftRightSame(first, tile.bits);
  const auto toRight = hn::Mul(a, hn::Sub(hn::Load(d, batch.x1 + i), x0)), toBottom = hn::Mul(b, hn::Sub(hn::Load(d, batch.y1 + i), y0));
  const auto needed = hn::Lt(hn::Add(e, hn::Add(hn::Min(toRight, zero), hn::Min(toBottom, zero))), zero);
  const auto c = hn::Sub(e, hn::Add(hn::Mul(a, x0), hn::Mul(b, y0)));
  hn::Store(hn::IfThenElseZero(needed, a), d, batch.a[edge] + i);
  hn::Store(hn::IfThenElseZero(needed, b), d, batch.b[edge] + i);
  hn::Store(hn::IfThenElseZero(needed, c), d, batch.c[edge] + i);
  return hn::Not(hn::Lt(hn::Add(e, hn::Add(hn::Max(toRight, zero), hn::Max(toBottom, zero))), zero));
}

// setUpAny of twice as many triangles, in half the time or less, if all are short: false where they are not.
HWY_INLINE HWY_ATTR bool setUpShort(EdgeBatch& batch, int i, const TileFrame& tile) {
  const Samples d;
  const hn::RebindToUnsigned<Samples> bits;
  const auto zero = hn::Zero(d), one = hn::Set(d, 1);
  const ShortCorner p(batch.p + i), second(batch.q + i), third(batch.r + i);
  const auto left = hn::Min(hn::Min(p.x, second.x), third.x), right = hn::Max(hn::Max(p.x, second.x), third.x);
  const auto top = hn::Min(hn::Min(p.y, second.y), third.y), bottom = hn::Max(hn::Max(p.y, second.y), third.y);
  if (!hn::AllFalse(d, hn::Gt(hn::Max(hn::Sub(right, left), hn::Sub(bottom, top)), hn::Set(d, kShort)))) return false;

  const auto first = [&](hn::Vec<Samples> least, int origin) HWY_ATTR {
    const auto sample = hn::ShiftRightSame(hn::Add(least, hn::Set(d, (1 << tile.bits) - 1)), tile.bits);
    return hn::Max(hn::Sub(sample, hn::Set(d, origin)), zero);
  };
  const auto last = [&](hn::Vec<Samples> most, int origin, int size) HWY_ATTR {
    return hn::Min(hn::Sub(hn::ShiftRightSame(most, tile.bits), hn::Set(d, origin)), hn::Set(d, size - 1));
  };
  const auto x0 = first(left, tile.x0), y0 = first(top, tile.y0), x1 = last(right, tile.x0, tile.width), y1 = last(bottom, tile.y0, tile.height);
  hn::Store(x0, d, batch.x0 + i);
  hn::Store(y0, d, batch.y0 + i);
  hn::Store(x1, d, batch.x1 + i);
  hn::Store(y1, d, batch.y1 + i);

  const auto area = hn::Sub(hn::Mul(hn::Sub(second.x, p.x), hn::Sub(third.y, p.y)), hn::Mul(hn::Sub(second.y, p.y), hn::Sub(third.x, p.x)));
  const int halved = 2 * tile.bits + 1;
  const auto pixels = hn::ShiftRightSame(hn::Add(hn::BitCast(bits, hn::Abs(area)), hn::Set(bits, (1u << halved) - 1)), halved);
  const auto half = hn::ShiftRight<1>(hn::Add(hn::Mul(hn::Add(hn::Sub(x1, x0), one), hn::Add(hn::Sub(y1, y0), one)), one));
  hn::Store(hn::Min(hn::BitCast(d, pixels), half), d, batch.samples + i);

  const auto front = hn::Lt(area, zero);
  const ShortCorner q(hn::IfThenElse(front, third.x, second.x), hn::IfThenElse(front, third.y, second.y));
  const ShortCorner r(hn::IfThenElse(front, second.x, third.x), hn::IfThenElse(front, second.y, third.y));
  const auto holds = hn::Not(hn::Or(hn::Eq(area, zero), hn::Or(hn::Lt(x1, x0), hn::Lt(y1, y0))));
  const auto pq = setUpShortEdge(batch, 0, i, p, q, tile), qr = setUpShortEdge(batch, 1, i, q, r, tile), rp = setUpShortEdge(batch, 2, i, r, p, tile);
  const auto side = hn::IfThenElse(front, one, hn::Set(d, -1));
  hn::Store(hn::IfThenElseZero(hn::And(hn::And(holds, pq), hn::And(qr, rp)), side), d, batch.side + i);
  return true;
}

HWY_ATTR void SetUpEdges(EdgeBatch& batch, int count, const TileFrame& tile) {
  const int group = static_cast<int>(hn::Lanes(Samples())), lanes = static_cast<int>(hn::Lanes(Exact()));
  // What a vector holds beyond the last triangle is none.
  for (int i = count; i % group != 0; ++i) batch.p[i] = batch.q[i] = batch.r[i] = {0, 0}, batch.planeClass[i] = batch.planeClass[0];
  Extents extents(batch.extent);
  batch.withEdges = 0;
  for (int i = 0; i < count; i += group) {
    if (!setUpShort(batch, i, tile)) {
      for (int k = i; k < i + group; k += lanes) setUpAny(batch, k, tile);
    }
    putSetups(batch, i);
    for (int k = i; k < i + group; k += lanes) addDepths(batch, k, tile, extents);
  }
  extents.addTo(batch.extent);
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
