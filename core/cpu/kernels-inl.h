// Included once per SIMD target by kernels.cpp; no include guard but Highway's.
#if defined(COPEEL_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_KERNELS_INL_H_
#undef COPEEL_KERNELS_INL_H_
#else
#define COPEEL_KERNELS_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/kernels.h"
#include "core/cpu/tile.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using I32 = hn::CappedTag<std::int32_t, kBlockSize>;
using F64 = hn::CappedTag<double, kBlockSize>;
using U64 = hn::CappedTag<std::uint64_t, kBlockSize>;

alignas(64) inline constexpr double kIota[kBlockSize] = {0, 1, 2, 3, 4, 5, 6, 7};
alignas(64) inline constexpr std::int32_t kIotaInt[kBlockSize] = {0, 1, 2, 3, 4, 5, 6, 7};

// Bit x of row y (bit 8·y + x) is set where all three edges are not negative. x, y: the block's first pixel in the tile.
HWY_INLINE HWY_ATTR std::uint64_t blockCoverage(const TriangleSetup& t, int x, int y) {
  std::int32_t e[3];
  bool full = true;
  for (int i = 0; i < 3; ++i) {
    e[i] = t.a[i] * x + t.b[i] * y + t.c[i];
    const std::int32_t across = (kBlockSize - 1) * t.a[i], down = (kBlockSize - 1) * t.b[i];
    if (e[i] + (across > 0 ? across : 0) + (down > 0 ? down : 0) < 0) return 0;
    full &= e[i] + (across < 0 ? across : 0) + (down < 0 ? down : 0) >= 0;
  }
  // Edges that the triangle's bounds make redundant were dropped, so the bounds count.
  const int x0 = t.x0 > x ? t.x0 - x : 0, x1 = t.x1 - x < kBlockSize - 1 ? t.x1 - x : kBlockSize - 1;
  const int y0 = t.y0 > y ? t.y0 - y : 0, y1 = t.y1 - y < kBlockSize - 1 ? t.y1 - y : kBlockSize - 1;
  const std::uint64_t columns = ((0xFFull >> (7 - x1 + x0)) << x0) * 0x0101010101010101ull;
  const std::uint64_t rows = (~std::uint64_t{0} >> (kBlockSize * (7 - y1 + y0))) << (kBlockSize * y0);
  if (full) return columns & rows;
  const I32 d;
  const std::size_t lanes = hn::Lanes(d);
  std::uint64_t bits = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += lanes) {
    const auto iota = hn::Load(d, kIotaInt + lane);
    auto e0 = hn::Add(hn::Set(d, e[0] + t.b[0] * y0), hn::Mul(hn::Set(d, t.a[0]), iota));
    auto e1 = hn::Add(hn::Set(d, e[1] + t.b[1] * y0), hn::Mul(hn::Set(d, t.a[1]), iota));
    auto e2 = hn::Add(hn::Set(d, e[2] + t.b[2] * y0), hn::Mul(hn::Set(d, t.a[2]), iota));
    const auto b0 = hn::Set(d, t.b[0]), b1 = hn::Set(d, t.b[1]), b2 = hn::Set(d, t.b[2]);
    for (int row = y0; row <= y1; ++row) {
      const auto outside = hn::Lt(hn::Or(hn::Or(e0, e1), e2), hn::Zero(d));
      std::uint8_t byte[8] = {};
      hn::StoreMaskBits(d, hn::Not(outside), byte);
      bits |= (std::uint64_t{byte[0]} & ((1u << lanes) - 1)) << (row * kBlockSize + lane);
      e0 = hn::Add(e0, b0), e1 = hn::Add(e1, b1), e2 = hn::Add(e2, b2);
    }
  }
  return bits & columns;
}

// keyAt of so many pixels of a row. x, y: the first one in the tile.
template <int kCount>
HWY_INLINE HWY_ATTR void rowKeys(const TriangleSetup& t, int x, int y, KeyFormat format, std::uint64_t* keys) {
  const hn::CappedTag<double, kCount> d;
  const hn::CappedTag<std::uint64_t, kCount> u;
  const auto da = hn::Set(d, t.da), base = hn::Set(d, t.db * y + t.dc);
  const auto lo = hn::Set(d, t.lo), hi = hn::Set(d, t.hi), first = hn::Set(d, static_cast<double>(x));
  const auto slot = hn::Set(u, std::uint64_t{t.slot});
  for (std::size_t lane = 0; lane < kCount; lane += hn::Lanes(d)) {
    const auto at = hn::Add(first, hn::Load(d, kIota + lane));
    const auto depth = hn::Min(hn::Max(hn::Add(hn::Mul(da, at), base), lo), hi);
    const auto bits = hn::ShiftRight<64 - kKeyBits>(hn::ShiftLeftSame(hn::BitCast(u, depth), 64 - format.depthBits));
    hn::Store(hn::Or(bits, slot), u, keys + lane);
  }
}

// A triangle whose bounds hold no more samples than a block is taken sample by sample, whatever blocks it lies in.
HWY_INLINE bool isSmall(const TriangleSetup& t) { return (t.x1 - t.x0 + 1) * (t.y1 - t.y0 + 1) <= kBlockPixels; }

// The blocks that the bounds touch, a bit for each.
HWY_INLINE std::uint32_t touchedBlocks(const TriangleSetup& t) {
  const int bx0 = t.x0 / kBlockSize, bx1 = t.x1 / kBlockSize, by0 = t.y0 / kBlockSize, by1 = t.y1 / kBlockSize;
  const std::uint32_t row = ((2u << bx1) - (1u << bx0)) * 0x1111u;
  return row & ((0x10u << (kBlocksPerSide * by1)) - (1u << (kBlocksPerSide * by0)));
}

HWY_INLINE std::uint32_t blocksOf(const BlockRect& rect) {
  std::uint32_t blocks = 0;
  for (int by = rect.by0; by < rect.by1; ++by) {
    for (int bx = rect.bx0; bx < rect.bx1; ++bx) blocks |= 1u << (by * kBlocksPerSide + bx);
  }
  return blocks;
}

// A window of 64 samples, 2^log to a row. Bit i stands for sample (x + i mod 2^log, y + i / 2^log).
struct Window {
  int x, y, log;
  int columns, rows;   // of samples inside the triangle's bounds
};

HWY_INLINE HWY_ATTR std::uint64_t windowCoverage(const TriangleSetup& t, const Window& w) {
  const I32 d;
  const int lanes = static_cast<int>(hn::Lanes(d)), samples = w.rows << w.log;
  std::uint64_t outside = 0;
  for (int lane = 0; lane < kBlockSize; lane += lanes) {
    const auto index = hn::Load(d, kIotaInt + lane);
    const auto column = hn::And(index, hn::Set(d, (1 << w.log) - 1)), row = hn::ShiftRightSame(index, w.log);
    const auto first = [&](int i) HWY_ATTR {
      const auto corner = hn::Set(d, t.a[i] * w.x + t.b[i] * w.y + t.c[i]);
      return hn::Add(corner, hn::Add(hn::Mul(hn::Set(d, t.a[i]), column), hn::Mul(hn::Set(d, t.b[i]), row)));
    };
    auto e0 = first(0), e1 = first(1), e2 = first(2);
    // Eight samples on.
    const int rowsOn = kBlockSize >> w.log;
    const auto s0 = hn::Set(d, t.b[0] * rowsOn), s1 = hn::Set(d, t.b[1] * rowsOn), s2 = hn::Set(d, t.b[2] * rowsOn);
    for (int i = 0; i < samples; i += kBlockSize) {
      std::uint8_t byte[8] = {};
      hn::StoreMaskBits(d, hn::Lt(hn::Or(hn::Or(e0, e1), e2), hn::Zero(d)), byte);
      outside |= std::uint64_t{byte[0]} << (i + lane);
      e0 = hn::Add(e0, s0), e1 = hn::Add(e1, s1), e2 = hn::Add(e2, s2);
    }
  }
  // Edges that the triangle's bounds make redundant were dropped, so the bounds count.
  static constexpr std::uint64_t kEveryRow[] = {~0ull, 0x5555555555555555ull, 0x1111111111111111ull, 0x0101010101010101ull};
  const std::uint64_t within = (kEveryRow[w.log] * ((1u << w.columns) - 1)) & (~std::uint64_t{0} >> (kBlockPixels - samples));
  return within & ~outside;
}

HWY_INLINE unsigned blockAt(unsigned x, unsigned y) { return y / kBlockSize * kBlocksPerSide + x / kBlockSize; }
HWY_INLINE unsigned pixelAt(unsigned x, unsigned y) { return y % kBlockSize * kBlockSize + x % kBlockSize; }

// Those of a triangle whose set-up has found the samples already.
template <class Visit>
HWY_INLINE HWY_ATTR void forEachCovered(const TriangleSetup& t, KeyFormat format, Visit visit) {
  constexpr unsigned kSide = 4;
  alignas(64) std::uint64_t keys[kSide * kSide];
  for (unsigned row = 0, last = t.y1 - t.y0; row <= last; ++row) rowKeys<kSide>(t, t.x0, t.y0 + static_cast<int>(row), format, keys + kSide * row);
  for (std::uint32_t covered = t.covered; covered; covered &= covered - 1) {
    const unsigned bit = static_cast<unsigned>(__builtin_ctz(covered)), x = t.x0 + bit % kSide, y = t.y0 + bit / kSide;
    visit(blockAt(x, y), pixelAt(x, y), keys[bit]);
  }
}

// `visit(block, pixel, key)` for the samples of a small triangle.
template <class Visit>
HWY_INLINE HWY_ATTR void forEachSample(const TriangleSetup& t, KeyFormat format, Visit visit) {
  if (t.covered) return forEachCovered(t, format, visit);
  // A window starts at the bounds' corner and has their shape: nearly every small triangle needs but one, where it would straddle two to
  // four blocks. One of up to 8 columns has 8·8 / columns rows at most, so that the windows of a column are never more than two.
  const int width = t.x1 - t.x0 + 1, log = width > 4 ? 3 : width > 2 ? 2 : width - 1;
  const int mostColumns = 1 << log, mostRows = kBlockPixels >> log;
  for (int y = t.y0; y <= t.y1; y += mostRows) {
    for (int x = t.x0; x <= t.x1; x += mostColumns) {
      const Window w{x, y, log, std::min(t.x1 - x + 1, mostColumns), std::min(t.y1 - y + 1, mostRows)};
      for (std::uint64_t covered = windowCoverage(t, w); covered; covered &= covered - 1) {
        const int bit = __builtin_ctzll(covered), px = x + (bit & (mostColumns - 1)), py = y + (bit >> log);
        visit(blockAt(static_cast<unsigned>(px), static_cast<unsigned>(py)), pixelAt(static_cast<unsigned>(px), static_cast<unsigned>(py)),
              keyAt(t, px, py, format));
      }
    }
  }
}

template <class Visit>
HWY_INLINE HWY_ATTR bool forEachBlock(const TriangleSetup& t, const BlockRect& rect, std::uint32_t finished, Visit visit) {
  const int bx0 = std::max(t.x0 / kBlockSize, rect.bx0), bx1 = std::min(t.x1 / kBlockSize + 1, rect.bx1);
  const int by0 = std::max(t.y0 / kBlockSize, rect.by0), by1 = std::min(t.y1 / kBlockSize + 1, rect.by1);
  for (int by = by0; by < by1; ++by) {
    for (int bx = bx0; bx < bx1; ++bx) {
      const int index = by * kBlocksPerSide + bx;
      if (finished >> index & 1) continue;
      const std::uint64_t covered = blockCoverage(t, bx * kBlockSize, by * kBlockSize);
      if (covered && !visit(index, bx * kBlockSize, by * kBlockSize, covered)) return false;
    }
  }
  return true;
}

HWY_INLINE HWY_ATTR bool sameCounts(const std::uint32_t* counts) {
  std::uint64_t pair[4];
  __builtin_memcpy(pair, counts, sizeof pair);
  const std::uint64_t first = std::uint64_t{counts[0]} * 0x100000001ull;
  return pair[0] == first && pair[1] == first && pair[2] == first && pair[3] == first;
}

// One more layer in each of the blocks.
HWY_INLINE bool makeRoom(FragmentGrid& grid, std::uint32_t blocks) {
  for (; blocks; blocks &= blocks - 1) {
    FragmentGrid::Block& block = grid.block(__builtin_ctz(blocks));
    if (block.used == block.capacity && !grid.grow(block)) return false;
    ++block.used;
  }
  return true;
}

HWY_ATTR bool CollectFragments(const TriangleSetup* triangles, std::size_t count, KeyFormat format, const BlockRect& rect,
                               std::uint32_t finished, FragmentGrid& grid) {
  const std::uint32_t open = blocksOf(rect) & ~finished;
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleSetup& t = triangles[i];
    const std::uint32_t touched = touchedBlocks(t);
    if (isSmall(t) && !(touched & ~open)) {
      if (!makeRoom(grid, touched)) return false;
      forEachSample(t, format, [&](unsigned index, unsigned pixel, std::uint64_t key) HWY_ATTR {
        FragmentGrid::Block& block = grid.block(index);
        block.keys[std::size_t{block.counts[pixel]++} * kBlockPixels + pixel] = key;
      });
      continue;
    }
    const bool room = forEachBlock(t, rect, finished, [&](int index, int x, int y, std::uint64_t covered) HWY_ATTR {
      FragmentGrid::Block& block = grid.block(index);
      if (block.used == block.capacity && !grid.grow(block)) return false;
      ++block.used;
      for (int row = __builtin_ctzll(covered) / kBlockSize; row < kBlockSize; ++row) {
        std::uint32_t mask = covered >> (row * kBlockSize) & 0xFF;
        if (!mask) continue;
        alignas(64) std::uint64_t keys[kBlockSize];
        rowKeys<kBlockSize>(t, x, y + row, format, keys);
        std::uint32_t* counts = block.counts + row * kBlockSize;
        std::uint64_t* pixels = block.keys.get() + row * kBlockSize;
        if (mask == 0xFF && sameCounts(counts)) {
          __builtin_memcpy(pixels + std::size_t{counts[0]} * kBlockPixels, keys, sizeof keys);
          for (int k = 0; k < kBlockSize; ++k) ++counts[k];
          continue;
        }
        for (; mask; mask &= mask - 1) {
          const int k = __builtin_ctz(mask);
          pixels[std::size_t{counts[k]++} * kBlockPixels + k] = keys[k];
        }
      }
      return true;
    });
    if (!room) return false;
  }
  return true;
}

HWY_ATTR void CollectNearest(const TriangleSetup* triangles, std::size_t count, KeyFormat format, const BlockRect& rect,
                             std::uint64_t* nearest) {
  const std::uint32_t open = blocksOf(rect);
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleSetup& t = triangles[i];
    if (isSmall(t) && !(touchedBlocks(t) & ~open)) {
      forEachSample(t, format, [&](unsigned block, unsigned pixel, std::uint64_t key) HWY_ATTR {
        std::uint64_t& least = nearest[block * kBlockPixels + pixel];
        least = std::min(least, key);
      });
      continue;
    }
    forEachBlock(t, rect, 0, [&](int index, int x, int y, std::uint64_t covered) HWY_ATTR {
      for (int row = __builtin_ctzll(covered) / kBlockSize; row < kBlockSize; ++row) {
        const std::uint32_t mask = covered >> (row * kBlockSize) & 0xFF;
        if (!mask) continue;
        alignas(64) std::uint64_t keys[kBlockSize];
        rowKeys<kBlockSize>(t, x, y + row, format, keys);
        std::uint64_t* pixels = nearest + index * kBlockPixels + row * kBlockSize;
        for (int k = 0; k < kBlockSize; ++k) {
          const std::uint64_t key = mask >> k & 1 ? keys[k] : kEmptyKey;
          pixels[k] = key < pixels[k] ? key : pixels[k];
        }
      }
      return true;
    });
  }
}

// Two planes whose keys do not tell their order.
inline bool isOpen(std::uint64_t nearer, std::uint64_t farther, KeyFormat format, const KeyDoubt& doubt) {
  if (farther - nearer >= doubt.reach) return false;
  return doubt.slots[doubt.lastSlot - format.slotOf(nearer)].planeClass != doubt.slots[doubt.lastSlot - format.slotOf(farther)].planeClass;
}

// A key that is nearer than the last, or as good as that: to its place among those kept.
inline void keepNearest(NearestGrid::Block& block, std::uint32_t k, int pixel, std::uint64_t key, KeyFormat format, const KeyDoubt& doubt) {
  std::uint64_t* keys = block.kept.keys.get() + pixel;
  std::uint64_t& last = keys[std::size_t{k - 1} * kBlockPixels];
  std::uint32_t& count = block.kept.counts[pixel];
  std::uint64_t lost = kEmptyKey;
  if (key < last) {
    lost = last;
    std::uint32_t at = count < k ? count++ : k - 1;
    for (; at > 0 && keys[std::size_t{at - 1} * kBlockPixels] > key; --at) keys[std::size_t{at} * kBlockPixels] = keys[std::size_t{at - 1} * kBlockPixels];
    keys[std::size_t{at} * kBlockPixels] = key;
  } else {
    lost = key;
  }
  if (lost != kEmptyKey && isOpen(last, lost, format, doubt)) block.doubtful |= std::uint64_t{1} << pixel;
}

// Which of eight keys may have a place before `last`.
HWY_INLINE HWY_ATTR std::uint32_t mayBeKept(const std::uint64_t* keys, const std::uint64_t* last, std::uint64_t reach) {
  const F64 d;
  const U64 u;
  std::uint32_t mask = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    const auto limit = hn::Add(hn::LoadU(u, last + lane), hn::Set(u, reach));
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(d, hn::Lt(hn::BitCast(d, hn::Load(u, keys + lane)), hn::BitCast(d, limit)), byte);
    mask |= (std::uint32_t{byte[0]} & ((1u << hn::Lanes(d)) - 1)) << lane;
  }
  return mask;
}

HWY_ATTR void CollectKNearest(const TriangleSetup* triangles, std::size_t count, KeyFormat format, const BlockRect& rect, const KeyDoubt& doubt,
                              NearestGrid& grid) {
  const std::uint32_t open = blocksOf(rect), k = grid.k();
  const std::size_t lastLayer = std::size_t{k - 1} * kBlockPixels;
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleSetup& t = triangles[i];
    if (isSmall(t) && !(touchedBlocks(t) & ~open)) {
      forEachSample(t, format, [&](unsigned index, unsigned pixel, std::uint64_t key) HWY_ATTR {
        NearestGrid::Block& block = grid.block(index);
        ++block.seen[pixel];
        if (key < block.kept.keys[lastLayer + pixel] + doubt.reach) keepNearest(block, k, static_cast<int>(pixel), key, format, doubt);
      });
      continue;
    }
    forEachBlock(t, rect, 0, [&](int index, int x, int y, std::uint64_t covered) HWY_ATTR {
      NearestGrid::Block& block = grid.block(index);
      for (int row = __builtin_ctzll(covered) / kBlockSize; row < kBlockSize; ++row) {
        std::uint32_t mask = covered >> (row * kBlockSize) & 0xFF;
        if (!mask) continue;
        alignas(64) std::uint64_t keys[kBlockSize];
        rowKeys<kBlockSize>(t, x, y + row, format, keys);
        for (int lane = 0; lane < kBlockSize; ++lane) block.seen[row * kBlockSize + lane] += mask >> lane & 1;
        mask &= mayBeKept(keys, block.kept.keys.get() + lastLayer + row * kBlockSize, doubt.reach);
        for (; mask; mask &= mask - 1) {
          const int lane = __builtin_ctz(mask);
          keepNearest(block, k, row * kBlockSize + lane, keys[lane], format, doubt);
        }
      }
      return true;
    });
  }
}

const char* SimdName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
