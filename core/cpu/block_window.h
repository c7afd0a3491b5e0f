// The part of a block's fragments whose order matters: what lies in front of a pixel's window (core/fold/fold.h) is set aside unordered, what
// lies behind it is left out. An intersection of many solids then orders next to nothing. O(fragments), against a sort of them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/fold/fold.h"

namespace copeel::cpu {

class BlockWindow {
 public:
  // `all`: in the order of slots.
  template <Fold F>
  void take(F& fold, const Tile& tile, const FragmentBlock& all) {
    makeRoom(all);
    before_.clear();
    for (int p = 0; p < kBlockPixels; ++p) {
      firstBefore_[p] = static_cast<std::uint32_t>(before_.size());
      counts_[p] = 0;
      if (all.counts[p] == 0) continue;
      const PixelStack stack = stackOf(all, p, tile);
      const DepthRange window = fold.window(stack);
      if (!window.empty()) takePixel(stack, p, window);
    }
    firstBefore_[kBlockPixels] = static_cast<std::uint32_t>(before_.size());
  }
  FragmentBlock block() { return {keys_.data(), counts_, kBlockPixels}; }
  // Slots in front of the pixel's window.
  std::span<const std::uint32_t> before(int pixel) const {
    return {before_.data() + firstBefore_[pixel], firstBefore_[pixel + 1] - firstBefore_[pixel]};
  }

 private:
  void makeRoom(const FragmentBlock& all) {
    const std::size_t size = std::size_t{*std::max_element(all.counts, all.counts + kBlockPixels)} * kBlockPixels + 1;
    if (keys_.size() < size) keys_ = UninitializedVector<std::uint64_t>(2 * size);
  }

  void takePixel(const PixelStack& stack, int pixel, const DepthRange& window) {
    std::uint64_t* out = keys_.data() + pixel;
    for (std::uint32_t i = 0; i < stack.count; ++i) {
      const DepthRange depth = stack.depth(i);
      if (depth.most < window.least) before_.push_back(stack.slot(i));
      else if (depth.least <= window.most) out[std::size_t{counts_[pixel]++} * kBlockPixels] = stack.key(i);
    }
  }

  UninitializedVector<std::uint64_t> keys_;
  std::uint32_t counts_[kBlockPixels] = {};
  std::vector<std::uint32_t> before_;
  std::uint32_t firstBefore_[kBlockPixels + 1] = {};
};

}  // namespace copeel::cpu
