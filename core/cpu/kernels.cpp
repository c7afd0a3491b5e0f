// Large triangles block by block, their keys row by row; small ones sample by sample, in one window or as their set-up has found them. The hot code is in kernels-inl.h, compiled
// once per target.
#include "core/cpu/kernels.h"

#include <algorithm>
#include <cstring>

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
HWY_EXPORT(CollectKNearest);
HWY_EXPORT(SimdName);

bool collectFragments(std::span<const TriangleSetup> triangles, KeyFormat format, const BlockRect& rect, std::uint32_t finished,
                      FragmentGrid& grid) {
  return HWY_DYNAMIC_DISPATCH(CollectFragments)(triangles.data(), triangles.size(), format, rect, finished, grid);
}

void collectNearest(std::span<const TriangleSetup> triangles, KeyFormat format, const BlockRect& rect, std::uint64_t* nearest) {
  HWY_DYNAMIC_DISPATCH(CollectNearest)(triangles.data(), triangles.size(), format, rect, nearest);
}

void collectKNearest(std::span<const TriangleSetup> triangles, KeyFormat format, const BlockRect& rect, const KeyDoubt& doubt, NearestGrid& grid) {
  HWY_DYNAMIC_DISPATCH(CollectKNearest)(triangles.data(), triangles.size(), format, rect, doubt, grid);
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

void FragmentGrid::clear() {
  for (Block& block : blocks_) {
    block.used = 0;
    std::fill(std::begin(block.counts), std::end(block.counts), 0u);
  }
}

// Of the buffers the last layer alone is written: there "no fragment" is farther than every key, whatever the layers before it hold.
void NearestGrid::clear() {
  for (Block& block : blocks_) {
    FragmentGrid::Block& kept = block.kept;
    if (kept.capacity != k_) {
      kept.keys = std::make_unique_for_overwrite<std::uint64_t[]>(std::size_t{k_} * kBlockPixels);
      kept.capacity = kept.used = k_;
    }
    std::fill_n(kept.keys.get() + std::size_t{k_ - 1} * kBlockPixels, kBlockPixels, kEmptyKey);
    std::fill(std::begin(kept.counts), std::end(kept.counts), 0u);
    std::fill(std::begin(block.seen), std::end(block.seen), 0u);
    block.doubtful = 0;
  }
}

bool FragmentGrid::grow(Block& block) {
  // `used` is an upper bound that counts triangles; fall back on the true maximum before taking memory.
  const std::uint32_t most = *std::max_element(std::begin(block.counts), std::end(block.counts));
  if (most < block.capacity) {
    block.used = most;
    return true;
  }
  const std::uint32_t capacity = std::max<std::uint32_t>(16, block.capacity * 2);
  const std::size_t layerBytes = kBlockPixels * sizeof(std::uint64_t);
  if (usedBytes_ + (capacity - block.capacity) * layerBytes > budgetBytes_) return false;
  auto keys = std::make_unique_for_overwrite<std::uint64_t[]>(std::size_t{capacity} * kBlockPixels + 1);
  if (most > 0) std::memcpy(keys.get(), block.keys.get(), most * layerBytes);
  usedBytes_ += (capacity - block.capacity) * layerBytes;
  block.keys = std::move(keys);
  block.capacity = capacity;
  block.used = most;
  return true;
}

}  // namespace copeel::cpu
