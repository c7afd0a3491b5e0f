// The part of a block's fragments whose order matters: what lies in front of a pixel's window (core/fold/fold.h) is set aside unordered, what
// lies behind it is left out. An intersection of many solids then orders next to nothing. O(fragments), against a sort of them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/fold/fold.h"

namespace copeel::cpu {

class BlockWindow {
 public:
  // `all`: in the order of slots.
  template <Fold F>
  void take(F& fold, const Tile& tile, const FragmentGrid::Block& all) {
    makeRoom(all);
    before_.clear();
    for (int p = 0; p < kBlockPixels; ++p) {
      firstBefore_[p] = static_cast<std::uint32_t>(before_.size());
      block_.counts[p] = 0;
      if (all.counts[p] == 0) continue;
      const PixelStack stack{all.keys.get() + p, all.counts[p], kBlockPixels, tile.format, tile.slots.data()};
      const DepthRange window = fold.window(stack);
      if (!window.empty()) takePixel(stack, p, window);
    }
    firstBefore_[kBlockPixels] = static_cast<std::uint32_t>(before_.size());
  }
  FragmentGrid::Block& block() { return block_; }
  // Slots in front of the pixel's window.
  std::span<const std::uint32_t> before(int pixel) const {
    return {before_.data() + firstBefore_[pixel], firstBefore_[pixel + 1] - firstBefore_[pixel]};
  }

 private:
  void makeRoom(const FragmentGrid::Block& all) {
    if (block_.capacity >= all.used) return;
    block_.capacity = all.capacity;
    block_.keys = std::make_unique_for_overwrite<std::uint64_t[]>(std::size_t{block_.capacity} * kBlockPixels);
  }

  void takePixel(const PixelStack& stack, int pixel, const DepthRange& window) {
    std::uint64_t* out = block_.keys.get() + pixel;
    for (std::uint32_t i = 0; i < stack.count; ++i) {
      const DepthRange depth = stack.depth(i);
      if (depth.most < window.least) before_.push_back(stack.slot(i));
      else if (depth.least <= window.most) out[std::size_t{block_.counts[pixel]++} * kBlockPixels] = stack.key(i);
    }
  }

  FragmentGrid::Block block_;
  std::vector<std::uint32_t> before_;
  std::uint32_t firstBefore_[kBlockPixels + 1] = {};
};

}  // namespace copeel::cpu
