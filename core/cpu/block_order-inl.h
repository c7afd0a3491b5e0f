// Included once per SIMD target by block_order.cpp; no include guard but Highway's.
#if defined(COPEEL_BLOCK_ORDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_BLOCK_ORDER_INL_H_
#undef COPEEL_BLOCK_ORDER_INL_H_
#else
#define COPEEL_BLOCK_ORDER_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/block_order.h"
#include "core/fold/fold.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::CappedTag<double, kBlockSize>;
using U64 = hn::CappedTag<std::uint64_t, kBlockSize>;
using I64 = hn::CappedTag<std::int64_t, kBlockSize>;

HWY_INLINE HWY_ATTR void compareExchange(std::uint64_t* p, std::uint64_t* q) {
  const F64 d;
  const U64 u;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    const auto a = hn::BitCast(d, hn::LoadU(u, p + lane)), b = hn::BitCast(d, hn::LoadU(u, q + lane));
    hn::StoreU(hn::BitCast(u, hn::Min(a, b)), u, p + lane);
    hn::StoreU(hn::BitCast(u, hn::Max(a, b)), u, q + lane);
  }
}

// Batcher's odd-even merge sort of n layers, eight pixels at once. Based on: Batcher. Sorting networks and their applications. AFIPS 1968.
// `stride`: keys from one layer to the next.
HWY_INLINE HWY_ATTR void sortLayers(std::uint64_t* layers, std::uint32_t n, std::size_t stride) {
  for (std::uint32_t log = 0; (1u << log) < n; ++log) {
    const std::uint32_t p = 1u << log;
    for (std::uint32_t k = p; k >= 1; k /= 2) {
      for (std::uint32_t j = k & (p - 1); j + k < n; j += 2 * k) {
        const std::uint32_t end = j + k < n - k ? j + k : n - k;
        for (std::uint32_t i = j; i < end; ++i) {
          if (i >> (log + 1) != (i + k) >> (log + 1)) continue;
          compareExchange(layers + i * stride, layers + (i + k) * stride);
        }
      }
    }
  }
}

// Beyond so many layers the steps of the network miss the caches, and sorting the keys of each pixel side by side is faster (measured, whole frames:
// 2,000 layers 1.5 times, 32,000 layers 2.3 times).
constexpr std::uint32_t kMostNetworkLayers = 1024;

// Layers of a row lie 512 bytes apart, so that of 64 lines on the way only some places of the cache are theirs: more layers are sorted side by side.
constexpr std::uint32_t kMostLayersInPlace = 32;

HWY_ATTR void sortRow(std::uint64_t* keys, std::uint32_t n) {
  if (n <= kMostLayersInPlace) return sortLayers(keys, n, kBlockPixels);
  alignas(64) std::uint64_t row[kMostNetworkLayers * kBlockSize];
  for (std::uint32_t i = 0; i < n; ++i) __builtin_memcpy(row + i * kBlockSize, keys + std::size_t{i} * kBlockPixels, sizeof(std::uint64_t) * kBlockSize);
  sortLayers(row, n, kBlockSize);
  for (std::uint32_t i = 0; i < n; ++i) __builtin_memcpy(keys + std::size_t{i} * kBlockPixels, row + i * kBlockSize, sizeof(std::uint64_t) * kBlockSize);
}

inline void sortColumn(std::uint64_t* keys, std::uint32_t count) {
  std::vector<std::uint64_t> column(count);
  for (std::uint32_t i = 0; i < count; ++i) column[i] = keys[std::size_t{i} * kBlockPixels];
  std::sort(column.begin(), column.end());
  for (std::uint32_t i = 0; i < count; ++i) keys[std::size_t{i} * kBlockPixels] = column[i];
}

HWY_ATTR void SortBlock(FragmentGrid::Block& block) {
  for (int row = 0; row < kBlockSize; ++row) {
    const std::uint32_t* counts = block.counts + row * kBlockSize;
    std::uint32_t n = 0;
    for (int k = 0; k < kBlockSize; ++k) n = counts[k] > n ? counts[k] : n;
    if (n < 2) continue;
    std::uint64_t* keys = block.keys.get() + row * kBlockSize;
    for (int k = 0; k < kBlockSize; ++k) {
      for (std::uint32_t layer = counts[k]; layer < n; ++layer) keys[std::size_t{layer} * kBlockPixels + k] = kEmptyKey;
      if (n > kMostNetworkLayers) sortColumn(keys + k, counts[k]);
    }
    if (n <= kMostNetworkLayers) sortRow(keys, n);
  }
}

// Lanes where a key and the next are `reach` or less apart; both fragments, or none.
HWY_INLINE HWY_ATTR std::uint32_t closeLanes(const std::uint64_t* keys, KeyFormat format, std::uint64_t reach) {
  const I64 d;
  std::uint32_t mask = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    const auto depth = [&](const std::uint64_t* at) HWY_ATTR {
      return hn::BitCast(d, hn::ShiftRightSame(hn::LoadU(U64(), at + lane), format.slotBits()));
    };
    const auto gap = hn::Sub(depth(keys + kBlockPixels), depth(keys));
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(d, hn::Lt(gap, hn::Set(d, static_cast<std::int64_t>(reach) + 1)), byte);
    mask |= (std::uint32_t{byte[0]} & ((1u << hn::Lanes(d)) - 1)) << lane;
  }
  return mask;
}

// Lanes 1 … 7 where a key has the slot of the one before.
HWY_INLINE HWY_ATTR std::uint32_t sameSlots(const std::uint64_t* keys, KeyFormat format) {
  const U64 u;
  const auto slot = hn::Set(u, (std::uint64_t{1} << format.slotBits()) - 1);
  std::uint32_t mask = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(u)) {
    const auto differs = hn::And(hn::Xor(hn::LoadU(u, keys + lane), hn::LoadU(u, keys + lane + 1)), slot);
    std::uint8_t byte[8] = {};
    hn::StoreMaskBits(u, hn::Eq(differs, hn::Zero(u)), byte);
    mask |= (std::uint32_t{byte[0]} & ((1u << hn::Lanes(u)) - 1)) << lane;
  }
  return mask << 1 & 0xFE;
}

HWY_ATTR BlockOrder OrderOfBlock(const FragmentGrid::Block& block, const Tile& tile) {
  const KeyFormat format = tile.format;
  const std::uint64_t reach = 2 * format.uncertainty;
  const TileSlot* const slots = tile.slots.data();
  BlockOrder order;
  for (int row = 0; row < kBlockSize; ++row) {
    const std::uint32_t* counts = block.counts + row * kBlockSize;
    const std::uint64_t* keys = block.keys.get() + row * kBlockSize;
    std::uint32_t most = 0, filled = 0, alike = 0;
    for (int k = 0; k < kBlockSize; ++k) {
      most = counts[k] > most ? counts[k] : most;
      filled |= std::uint32_t{counts[k] > 0} << k;
      alike |= std::uint32_t{k > 0 && counts[k] == counts[k - 1]} << k;
    }
    std::uint32_t open = 0, coplanar = 0, before = 0;   // before: lanes whose class is known, as they were close to the key before
    std::uint32_t classes[kBlockSize];
    for (int k = 0; k < kBlockSize && tile.coarse; ++k) open |= std::uint32_t{PixelStack{keys + k, counts[k], kBlockPixels, format, slots}.hasCoarse()} << k;
    for (std::uint32_t i = 0; i < most; ++i, keys += kBlockPixels) {
      if (alike) alike &= sameSlots(keys, format);
      if (i + 1 == most) break;
      const std::uint32_t close = closeLanes(keys, format, reach) & ~open;
      for (std::uint32_t left = close; left; left &= left - 1) {
        const int k = __builtin_ctz(left);
        if (i + 1 >= counts[k]) continue;
        const std::uint32_t here = before >> k & 1 ? classes[k] : slots[format.slotOf(keys[k])].planeClass;
        classes[k] = slots[format.slotOf(keys[kBlockPixels + k])].planeClass;
        (here == classes[k] ? coplanar : open) |= 1u << k;
      }
      before = close;
    }
    const std::uint32_t certain = filled & ~open;
    order.certain |= std::uint64_t{certain} << (row * kBlockSize);
    order.coplanar |= std::uint64_t{coplanar & certain} << (row * kBlockSize);
    order.repeats |= std::uint64_t{alike & certain & certain << 1} << (row * kBlockSize);
  }
  return order;
}

// Every layer of the block has one slot.
HWY_INLINE HWY_ATTR bool hasOneSlot(const std::uint64_t* keys, std::uint64_t slotMask) {
  const U64 u;
  const auto first = hn::Set(u, keys[0]);
  auto differs = hn::Zero(u);
  for (std::size_t p = 0; p < kBlockPixels; p += hn::Lanes(u)) differs = hn::Or(differs, hn::Xor(hn::LoadU(u, keys + p), first));
  return hn::AllTrue(u, hn::Eq(hn::And(differs, hn::Set(u, slotMask)), hn::Zero(u)));
}

HWY_ATTR bool SameStacks(const FragmentGrid::Block& block, const Tile& tile) {
  constexpr std::uint32_t kMostLayers = 16;   // with more, few blocks are alike
  const hn::CappedTag<std::uint32_t, kBlockSize> d;
  const std::uint32_t count = block.counts[0];
  if (count == 0 || count > kMostLayers) return false;
  auto differs = hn::Zero(d);
  for (std::size_t p = 0; p < kBlockPixels; p += hn::Lanes(d)) differs = hn::Or(differs, hn::Xor(hn::LoadU(d, block.counts + p), hn::Set(d, count)));
  if (!hn::AllTrue(d, hn::Eq(differs, hn::Zero(d)))) return false;

  const KeyFormat format = tile.format;
  const TileSlot* before = nullptr;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t* keys = block.keys.get() + std::size_t{i} * kBlockPixels;
    if (!hasOneSlot(keys, (std::uint64_t{1} << format.slotBits()) - 1)) return false;
    const TileSlot& slot = tile.slots[format.slotOf(keys[0])];
    if (slot.coarseBound) return false;
    if (before && before->planeClass != slot.planeClass) {
      for (int row = 0; row < kBlockSize; ++row) {
        if (closeLanes(keys - kBlockPixels + row * kBlockSize, format, 2 * format.uncertainty)) return false;
      }
    }
    before = &slot;
  }
  return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
