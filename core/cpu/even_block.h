// A block that each triangle covers wholly or not at all, in an order that holds in every pixel, as inside large faces. One pixel then stands
// for all, and neither coverage nor keys are made for the others. O(triangles of the tile).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/cpu/tile.h"
#include "core/fold/fold.h"
#include "core/image/image.h"

namespace copeel::cpu {

class EvenBlock {
 public:
  // `pixels`: of the image. False where it is not even, as far as its corners tell. After Tile::finish.
  bool find(const Tile& tile, const PixelRect& pixels);
  // Of each of its pixels, front to back.
  PixelStack stack(const Tile& tile) const {
    return {layers_.front().data(), static_cast<std::uint32_t>(layers_.size()), kCorners, tile.keys.format, tile.slots.data()};
  }
  bool empty() const { return layers_.empty(); }

 private:
  static constexpr std::uint32_t kCorners = 4;
  using Layer = std::array<std::uint64_t, kCorners>;   // keys in the corner pixels

  std::vector<Layer> layers_;
};

}  // namespace copeel::cpu
