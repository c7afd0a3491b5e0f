// Included once per SIMD target by block_order.cpp; no include guard but Highway's.
#if defined(COPEEL_BLOCK_ORDER_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_BLOCK_ORDER_INL_H_
#undef COPEEL_BLOCK_ORDER_INL_H_
#else
#define COPEEL_BLOCK_ORDER_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/block_order.h"
#include "core/cpu/lanes-inl.h"
#include "core/fold/fold.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F64 = hn::CappedTag<double, kBlockSize>;
using U64 = hn::CappedTag<std::uint64_t, kBlockSize>;
using I64 = hn::CappedTag<std::int64_t, kBlockSize>;

// `visit(i, j)`, i < j: the compare-exchanges of Batcher's odd-even merge sort of n elements in sorted groups of 2^log. Based on: Batcher. Sorting
// networks and their applications. AFIPS 1968.
template <class Visit>
HWY_ATTR constexpr void forEachSortStep(std::uint32_t n, std::uint32_t log, const Visit& visit) {
  for (; (1u << log) < n; ++log) {
    const std::uint32_t p = 1u << log;
    for (std::uint32_t k = p; k >= 1; k /= 2) {
      for (std::uint32_t j = k & (p - 1); j + k < n; j += 2 * k) {
        const std::uint32_t end = j + k < n - k ? j + k : n - k;
        for (std::uint32_t i = j; i < end; ++i) {
          if (i >> (log + 1) == (i + k) >> (log + 1)) visit(i, i + k);
        }
      }
    }
  }
}

struct SortStep {
  std::uint8_t first, second;
};

// Groups of so many layers are sorted in registers, then merged.
inline constexpr std::uint32_t kGroup = 16, kGroupLog = 4;

// Of a group of two or more.
template <std::uint32_t kCount>
struct GroupSteps {
  static constexpr std::size_t count() {
    std::size_t n = 0;
    forEachSortStep(kCount, 0, [&](std::uint32_t, std::uint32_t) { ++n; });
    return n;
  }
  SortStep steps[count()] = {};

  HWY_ATTR constexpr GroupSteps() {
    std::size_t n = 0;
    forEachSortStep(kCount, 0, [&](std::uint32_t i, std::uint32_t j) { steps[n++] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)}; });
  }
};

HWY_INLINE HWY_ATTR void putInOrder(hn::Vec<F64>& a, hn::Vec<F64>& b) {
  const auto nearer = hn::Min(a, b);
  b = hn::Max(a, b);
  a = nearer;
}

template <std::uint32_t kCount, std::size_t... kSteps>
HWY_INLINE HWY_ATTR void sortVectors(hn::Vec<F64>* v, std::index_sequence<kSteps...>) {
  constexpr GroupSteps<kCount> network;
  (putInOrder(v[network.steps[kSteps].first], v[network.steps[kSteps].second]), ...);
}

// `stride`: keys from one layer to the next.
template <std::uint32_t kCount>
HWY_INLINE HWY_ATTR void sortGroup(std::uint64_t* layers, std::size_t stride) {
  const F64 d;
  const U64 u;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    hn::Vec<F64> v[kCount];
    for (std::uint32_t i = 0; i < kCount; ++i) v[i] = hn::BitCast(d, hn::LoadU(u, layers + i * stride + lane));
    sortVectors<kCount>(v, std::make_index_sequence<GroupSteps<kCount>::count()>());
    for (std::uint32_t i = 0; i < kCount; ++i) hn::StoreU(hn::BitCast(u, v[i]), u, layers + i * stride + lane);
  }
}

// Of less than a group.
HWY_INLINE HWY_ATTR void sortPart(std::uint64_t* layers, std::uint32_t n, std::size_t stride) {
  switch (n) {
    case 2: return sortGroup<2>(layers, stride);
    case 3: return sortGroup<3>(layers, stride);
    case 4: return sortGroup<4>(layers, stride);
    case 5: return sortGroup<5>(layers, stride);
    case 6: return sortGroup<6>(layers, stride);
    case 7: return sortGroup<7>(layers, stride);
    case 8: return sortGroup<8>(layers, stride);
    case 9: return sortGroup<9>(layers, stride);
    case 10: return sortGroup<10>(layers, stride);
    case 11: return sortGroup<11>(layers, stride);
    case 12: return sortGroup<12>(layers, stride);
    case 13: return sortGroup<13>(layers, stride);
    case 14: return sortGroup<14>(layers, stride);
    case 15: return sortGroup<15>(layers, stride);
    default: return;
  }
}

inline constexpr std::uint32_t kMostTabledLayers = 64;

// The steps that merge the groups of up to so many layers, one after another, as finding the next one takes as long as the step.
struct MergeSteps {
  std::uint16_t begin[kMostTabledLayers + 2] = {};
  SortStep steps[7351] = {};

  HWY_ATTR constexpr MergeSteps() {
    std::uint16_t count = 0;
    for (std::uint32_t n = 0; n <= kMostTabledLayers; ++n) {
      begin[n] = count;
      forEachSortStep(n, kGroupLog, [&](std::uint32_t i, std::uint32_t j) HWY_ATTR { steps[count++] = {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j)}; });
    }
    begin[kMostTabledLayers + 1] = count;
  }
  std::span<const SortStep> of(std::uint32_t n) const { return {steps + begin[n], steps + begin[n + 1]}; }
};
inline constexpr MergeSteps kMergeSteps;
static_assert(kMergeSteps.begin[kMostTabledLayers + 1] == std::size(kMergeSteps.steps));

HWY_INLINE HWY_ATTR void compareExchange(std::uint64_t* p, std::uint64_t* q) {
  const F64 d;
  const U64 u;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    auto a = hn::BitCast(d, hn::LoadU(u, p + lane)), b = hn::BitCast(d, hn::LoadU(u, q + lane));
    putInOrder(a, b);
    hn::StoreU(hn::BitCast(u, a), u, p + lane);
    hn::StoreU(hn::BitCast(u, b), u, q + lane);
  }
}

HWY_INLINE HWY_ATTR void sortLayers(std::uint64_t* layers, std::uint32_t n, std::size_t stride) {
  const std::uint32_t whole = n / kGroup * kGroup;
  for (std::uint32_t i = 0; i < whole; i += kGroup) sortGroup<kGroup>(layers + i * stride, stride);
  sortPart(layers + whole * stride, n - whole, stride);
  if (n <= kMostTabledLayers) {
    for (const SortStep& step : kMergeSteps.of(n)) compareExchange(layers + step.first * stride, layers + step.second * stride);
    return;
  }
  forEachSortStep(n, kGroupLog, [&](std::uint32_t i, std::uint32_t j) HWY_ATTR { compareExchange(layers + i * stride, layers + j * stride); });
}

// Beyond so many layers the steps of the network miss the caches, and sorting the keys of each pixel side by side is faster (measured, whole frames:
// 2,000 layers 1.5 times, 32,000 layers 2.3 times).
constexpr std::uint32_t kMostNetworkLayers = 1024;

// More layers are sorted side by side: those of a block's own grid lie 512 bytes apart, so that of 64 lines on the way only some places of the cache are
// theirs, and each of a tile's grid lies in another page.
constexpr std::uint32_t mostLayersInPlace(std::size_t stride) { return stride == kBlockPixels ? 32 : 64; }

HWY_ATTR void sortRow(std::uint64_t* keys, std::uint32_t n, std::size_t stride) {
  if (n <= mostLayersInPlace(stride)) return sortLayers(keys, n, stride);
  alignas(64) std::uint64_t row[kMostNetworkLayers * kBlockSize];
  for (std::uint32_t i = 0; i < n; ++i) __builtin_memcpy(row + i * kBlockSize, keys + i * stride, sizeof(std::uint64_t) * kBlockSize);
  sortLayers(row, n, kBlockSize);
  for (std::uint32_t i = 0; i < n; ++i) __builtin_memcpy(keys + i * stride, row + i * kBlockSize, sizeof(std::uint64_t) * kBlockSize);
}

inline void sortColumn(std::uint64_t* keys, std::uint32_t count, std::size_t stride) {
  std::vector<std::uint64_t> column(count);
  for (std::uint32_t i = 0; i < count; ++i) column[i] = keys[i * stride];
  std::sort(column.begin(), column.end());
  for (std::uint32_t i = 0; i < count; ++i) keys[i * stride] = column[i];
}

HWY_ATTR void SortBlock(const FragmentBlock& block) {
  for (int row = 0; row < kBlockSize; ++row) {
    const std::uint32_t* counts = block.counts + row * kBlockSize;
    const std::uint32_t n = largestOf({counts, kBlockSize});
    if (n == 0) continue;
    std::uint64_t* keys = block.keys + row * kBlockSize;
    for (std::uint32_t shorter = lanesBelow(counts, n); shorter; shorter &= shorter - 1) {
      const int k = __builtin_ctz(shorter);
      for (std::uint32_t layer = counts[k]; layer < n; ++layer) keys[std::size_t{layer} * block.stride + k] = kEmptyKey;
    }
    if (n > kMostNetworkLayers) {
      for (int k = 0; k < kBlockSize; ++k) sortColumn(keys + k, counts[k], block.stride);
    } else if (n > 1) {
      sortRow(keys, n, block.stride);
    }
  }
}

// Lanes where a key and the next are `reach` or less apart; both fragments, or none.
HWY_INLINE HWY_ATTR std::uint32_t closeLanes(const std::uint64_t* keys, const std::uint64_t* next, KeyFormat format, std::uint64_t reach) {
  const I64 d;
  std::uint32_t mask = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    const auto depth = [&](const std::uint64_t* at) HWY_ATTR {
      return hn::BitCast(d, hn::ShiftRightSame(hn::LoadU(U64(), at + lane), format.slotBits()));
    };
    const auto gap = hn::Sub(depth(next), depth(keys));
    mask |= bitsOf(d, hn::Lt(gap, hn::Set(d, static_cast<std::int64_t>(reach) + 1))) << lane;
  }
  return mask;
}

// Every layer of the block has one slot.
HWY_INLINE HWY_ATTR bool hasOneSlot(const std::uint64_t* keys, std::uint64_t slotMask) {
  const U64 u;
  const auto first = hn::Set(u, keys[0]);
  auto differs = hn::Zero(u);
  for (std::size_t p = 0; p < kBlockPixels; p += hn::Lanes(u)) differs = hn::Or(differs, hn::Xor(hn::LoadU(u, keys + p), first));
  return hn::AllTrue(u, hn::Eq(hn::And(differs, hn::Set(u, slotMask)), hn::Zero(u)));
}

HWY_ATTR bool SameStacks(const FragmentBlock& block, const Tile& tile) {
  constexpr std::uint32_t kMostLayers = 16;   // with more, few blocks are alike
  const hn::CappedTag<std::uint32_t, kBlockSize> d;
  const std::uint32_t count = block.counts[0];
  if (count == 0 || count > kMostLayers) return false;
  auto differs = hn::Zero(d);
  for (std::size_t p = 0; p < kBlockPixels; p += hn::Lanes(d)) differs = hn::Or(differs, hn::Xor(hn::LoadU(d, block.counts + p), hn::Set(d, count)));
  if (!hn::AllTrue(d, hn::Eq(differs, hn::Zero(d)))) return false;

  const KeyFormat format = tile.keys.format;
  const TileSlot* before = nullptr;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint64_t* keys = block.layer(i);
    if (!hasOneSlot(keys, format.slotMask())) return false;
    const TileSlot& slot = tile.slots[format.slotOf(keys[0])];
    if (tile.coarse && tile.coarseBounds[format.slotOf(keys[0])]) return false;
    if (before && before->planeClass != slot.planeClass) {
      for (int row = 0; row < kBlockSize; ++row) {
        if (closeLanes(block.layer(i - 1) + row * kBlockSize, keys + row * kBlockSize, format, 2 * format.uncertainty)) return false;
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
