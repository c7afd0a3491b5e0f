// What an application makes of a pixel. A fold is given the fragments of a pixel front to back, coplanar ones from the last slot to the first, is told
// when a coplanar group is complete, and may say "enough". One fold object serves one thread. A result depends on the triangles met and their grouping
// alone, not on the pixel or the depths: neighbouring pixels with the same fragments are folded once.
//
// A fold that takesBlocks() also has foldBlock(block, tile, pixels, x, y), which folds at once those of the pixels of a sorted block whose keys tell the
// order of what is met, and ends them. x, y: the block's first pixel in the image. It returns FoldedPixels.
#pragma once

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <span>

#include "core/cpu/tile.h"
#include "core/image/image.h"

namespace copeel {

// Of a block, a bit each.
struct FoldedPixels {
  std::uint64_t folded = 0;
  std::uint64_t coplanar = 0;   // folded, and met coplanar fragments
};

// The fragments of a pixel.
struct PixelStack {
  const std::uint64_t* keys;
  std::uint32_t count;
  std::uint32_t stride;
  cpu::KeyFormat format;
  const cpu::TileSlot* slots;
  const std::uint64_t* coarseBounds = nullptr;   // per slot, where some are coarse (cpu::Tile)
  std::span<const std::uint32_t> before = {};   // slots in front of all keys, in no order

  std::uint64_t key(std::uint32_t i) const { return keys[std::size_t{i} * stride]; }
  std::uint32_t slot(std::uint32_t i) const { return format.slotOf(key(i)); }
  // Some depth is so uncertain that its neighbours in order may not be adjacent.
  bool hasCoarse() const {
    for (std::uint32_t i = 0; coarseBounds && i < count; ++i) {
      if (coarseBounds[slot(i)]) return true;
    }
    return false;
  }
  // Bound of the depth error of a slot, key units.
  std::uint64_t uncertaintyOf(std::uint32_t slot) const { return std::max(coarseBounds ? coarseBounds[slot] : 0, format.uncertainty); }
  // Bounds of the true depth, in key units.
  cpu::DepthRange depth(std::uint32_t i) const {
    const std::uint64_t k = key(i);
    const auto depth = static_cast<double>(static_cast<std::int64_t>(format.depthOf(k)));
    const auto uncertainty = static_cast<double>(static_cast<std::int64_t>(uncertaintyOf(format.slotOf(k))));
    return {depth - uncertainty, depth + uncertainty};
  }
};

inline PixelStack stackOf(const cpu::FragmentBlock& block, int pixel, const cpu::Tile& tile) {
  return {block.keys + pixel, block.counts[pixel], block.stride, tile.keys.format, tile.slots.data(), tile.coarse ? tile.coarseBounds.data() : nullptr};
}

template <class F>
concept Fold = requires(F fold, cpu::Tile& tile, std::span<const cpu::DepthRange> ranges, const PixelStack& stack, std::uint32_t slot,
                        const PixelRect& rect) {
  // Looks at the tile's objects, may drop some; false: no pixel of the tile shows anything.
  { fold.beginTile(tile) } -> std::same_as<bool>;
  // Looks at the depths of the kept objects, may drop more; returns the order value (depth_planes.h) beyond which nothing matters,
  // -inf when no pixel of the tile shows anything.
  { fold.narrowTile(tile) } -> std::convertible_to<double>;
  // False: no pixel shows anything where the tile's objects lie in these ranges, as in a part of the tile.
  { fold.mayShow(ranges) } -> std::same_as<bool>;
  // True when the tile's pixels need their whole stack before they start.
  { fold.needsWholeStack() } -> std::same_as<bool>;
  // No pixel of the tile has enough with fewer fragments.
  { fold.leastFragments() } -> std::convertible_to<double>;
  // For a pixel with its fragments in the order of their slots: bounds of the depths in which results can be true, in key units.
  // Fragments certainly in front of it need no order, those behind it are not needed.
  { fold.window(stack) } -> std::same_as<cpu::DepthRange>;
  // The ordered fragments of a pixel; those of `before` count as met. Pixels without fragments are passed over.
  fold.beginPixel(stack);
  fold.fragment(slot);
  // The fragments since the last call lie at one depth. True: enough, nothing behind matters.
  { fold.closeGroup() } -> std::same_as<bool>;
  fold.endPixels(rect);                     // of the image: all are as the one folded last
};

}  // namespace copeel
