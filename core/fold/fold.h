// What an application makes of a pixel. A fold is given the fragments of a pixel front to back, is told when a coplanar group is complete,
// and may say "enough". One fold object serves one thread. A result depends on the triangles met and their grouping alone, not on the pixel or
// the depths: neighbouring pixels with the same fragments are folded once.
#pragma once

#include <concepts>
#include <cstdint>
#include <span>

#include "core/cpu/tile.h"

namespace copeel {

// The ordered fragments of a pixel, for folds that must look at all of them first.
struct PixelStack {
  const std::uint64_t* keys;
  std::uint32_t count;
  std::uint32_t stride;
  cpu::KeyFormat format;
  const cpu::TileSlot* slots;

  std::uint64_t key(std::uint32_t i) const { return keys[std::size_t{i} * stride]; }
  std::uint32_t slot(std::uint32_t i) const { return format.slotOf(key(i)); }
};

template <class F>
concept Fold = requires(F fold, cpu::Tile& tile, std::span<const cpu::DepthRange> ranges, const PixelStack& stack, std::uint32_t slot, int x,
                        int y) {
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
  fold.beginPixel(stack);
  fold.fragment(slot);
  // The fragments since the last call lie at one depth. True: enough, nothing behind matters.
  { fold.closeGroup() } -> std::same_as<bool>;
  fold.endPixel(x, y);                      // image coordinates
};

}  // namespace copeel
