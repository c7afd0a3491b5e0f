// Included once per SIMD target by single_tile.cpp; no include guard but Highway's.
#if defined(COPEEL_SINGLE_TILE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_SINGLE_TILE_INL_H_
#undef COPEEL_SINGLE_TILE_INL_H_
#else
#define COPEEL_SINGLE_TILE_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/single_tile.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using Whole = hn::CappedTag<std::int32_t, 8>;
using Lanes = hn::Vec<Whole>;

// Along one axis.
struct Span {
  hn::Mask<Whole> empty, many;   // of samples, of tiles
  Lanes tile;                    // the first
};

// Samples have whole-pixel coordinates: the first at or after the smallest corner, the last at or before the largest.
HWY_INLINE HWY_ATTR Span spanOf(Lanes smallest, Lanes largest, int bits, int size) {
  static_assert(kTileSize == 1 << 5);
  const Whole d;
  const Lanes first = hn::Max(hn::ShiftRightSame(hn::Add(smallest, hn::Set(d, (1 << bits) - 1)), bits), hn::Zero(d));
  const Lanes last = hn::Min(hn::ShiftRightSame(largest, bits), hn::Set(d, size - 1));
  const Lanes tile = hn::ShiftRight<5>(first);
  return {hn::Lt(last, first), hn::Ne(tile, hn::ShiftRight<5>(last)), tile};
}

HWY_ATTR void FindSingleTiles(CornerBatch& batch, std::size_t count, const TileGrid& grid) {
  const Whole d;
  for (std::size_t i = 0; i < count; i += hn::Lanes(d)) {
    Lanes px, py, qx, qy, rx, ry;
    hn::LoadInterleaved2(d, &batch.p[i].x, px, py);
    hn::LoadInterleaved2(d, &batch.q[i].x, qx, qy);
    hn::LoadInterleaved2(d, &batch.r[i].x, rx, ry);
    const Lanes left = hn::Min(hn::Min(px, qx), rx);
    const Span x = spanOf(left, hn::Max(hn::Max(px, qx), rx), grid.bits, grid.width);
    const Span y = spanOf(hn::Min(hn::Min(py, qy), ry), hn::Max(hn::Max(py, qy), ry), grid.bits, grid.height);
    const Lanes only = hn::Add(hn::Mul(y.tile, hn::Set(d, grid.columns)), x.tile), many = hn::Set(d, kManyTiles);
    const Lanes onGrid = hn::IfThenElse(hn::Or(x.empty, y.empty), hn::Set(d, kNoTile), hn::IfThenElse(hn::Or(x.many, y.many), many, only));
    hn::Store(hn::IfThenElse(hn::Eq(left, hn::Set(d, kOffGrid)), many, onGrid), d, batch.tile + i);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
