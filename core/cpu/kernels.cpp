// Large triangles block by block, their keys row by row; small ones sample by sample, in windows or as their set-up has found them. The hot code is
// in kernels-inl.h, compiled once per target.
#include "core/cpu/kernels.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <new>
#include <numeric>

#include "core/cpu/tile.h"
#include "core/error.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/cpu/kernels-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/cpu/kernels-inl.h"

namespace copeel::cpu {

HWY_EXPORT(CollectFragments);
HWY_EXPORT(CollectNearest);
HWY_EXPORT(CountPixels);
HWY_EXPORT(CollectKNearest);
HWY_EXPORT(SimdName);

bool collectFragments(std::span<const TriangleSetup> triangles, const TileKeys& keys, const BlockRect& rect, std::uint32_t finished,
                      FragmentGrid& grid) {
  return HWY_DYNAMIC_DISPATCH(CollectFragments)(triangles, keys, rect, finished, grid);
}

PixelCounts countPixels(std::span<const std::uint32_t> counts, std::uint32_t nearest) { return HWY_DYNAMIC_DISPATCH(CountPixels)(counts, nearest); }

void collectNearest(std::span<const TriangleSetup> triangles, const TileKeys& keys, std::uint64_t* nearest) {
  HWY_DYNAMIC_DISPATCH(CollectNearest)(triangles.data(), triangles.size(), keys, nearest);
}

void collectKNearest(std::span<const TriangleSetup> triangles, const TileKeys& keys, const KeyDoubt& doubt, NearestGrid& grid) {
  HWY_DYNAMIC_DISPATCH(CollectKNearest)(triangles.data(), triangles.size(), keys, doubt, grid);
}

const char* simdInUse() { return HWY_DYNAMIC_DISPATCH(SimdName)(); }

void chooseSimd(const char* name) {
  hwy::DisableTargets(0);
  if (!std::strcmp(name, "best")) return;
  std::int64_t disabled = HWY_AVX3 | HWY_AVX3_DL;
  if (!std::strcmp(name, "sse4")) disabled |= HWY_AVX2;
  if (!std::strcmp(name, "scalar")) disabled = ~static_cast<std::int64_t>(HWY_STATIC_TARGET);
  hwy::DisableTargets(disabled);
  hwy::GetChosenTarget().DeInit();
}

void FragmentGrid::begin(const BlockRect& rect) {
  constexpr std::size_t kUnlimited = ~std::size_t{0};
  const bool isBlock = rect.count() == 1;
  stride_ = isBlock ? kBlockPixels : kTileStride;
  origin_ = isBlock ? static_cast<std::uint32_t>(rect.by0 * kBlocksPerSide + rect.bx0) * kBlockPixels : 0;
  limitBytes_ = isBlock ? kUnlimited : budgetBytes_;
  // What a block took beyond the budget is given back.
  if (!isBlock && keys_.size() > budgetBytes_ / sizeof(std::uint64_t) + 1) keys_ = {};
  capacity_ = static_cast<std::uint32_t>(keys_.size() / stride_);
  std::fill(std::begin(counts_), std::end(counts_), 0u);
}

FragmentGrid::Room FragmentGrid::room(std::uint32_t used) {
  constexpr std::uint32_t kLeastRoom = 32;   // layers: finding out how many are in use should be rare
  if (used + kLeastRoom > capacity_ && !grow(used + kLeastRoom)) return {};
  return {keys_.data(), capacity_ - used};
}

bool FragmentGrid::grow(std::size_t least) {
  const std::size_t most = limitBytes_ / (stride_ * sizeof(std::uint64_t));
  if (least > most) return false;
  constexpr std::size_t kFirst = 256;   // rarely less than a tile has triangles, and what no pixel reaches is not touched
  const std::size_t layers = std::min(std::max({least, std::size_t{capacity_} * 2, kFirst}), most);
  if (layers * stride_ > std::numeric_limits<std::uint32_t>::max()) throw std::bad_alloc();   // 32 GB: their places have 32 bits
  // The last pixel's neighbour is read.
  UninitializedVector<std::uint64_t> keys(layers * stride_ + 1);
  std::copy_n(keys_.data(), std::size_t{capacity_} * stride_, keys.data());
  keys_.swap(keys);
  capacity_ = static_cast<std::uint32_t>(layers);
  return true;
}

// Of the buffers the last layer alone is written: there "no fragment" is farther than every key, whatever the layers before it hold.
void NearestGrid::clear() {
  for (Block& block : blocks_) {
    if (!block.keys) block.keys = std::make_unique_for_overwrite<std::uint64_t[]>(std::size_t{k_} * kBlockPixels + 1);
    std::fill_n(block.keys.get() + std::size_t{k_ - 1} * kBlockPixels, kBlockPixels, kEmptyKey);
    std::fill(std::begin(block.counts), std::end(block.counts), 0u);
    std::fill(std::begin(block.seen), std::end(block.seen), 0u);
    block.doubtful = 0;
  }
}

}  // namespace copeel::cpu
