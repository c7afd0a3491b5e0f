// Triangles that lie in one tile, as most do, are told from the others in batches, vectorised across triangles with run-time dispatch. Whole
// numbers only: every target gives the same.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/cpu/projection.h"

namespace copeel::cpu {

struct TileGrid {
  int bits;            // sub-pixel bits of the corners
  int width, height;   // of the image, pixels
  int columns;         // of tiles
};

// What is found besides the number of a tile.
inline constexpr std::int32_t kNoTile = -1;      // the bounds hold no sample of the image
inline constexpr std::int32_t kManyTiles = -2;   // they reach into several tiles, or a corner is off the grid

struct CornerBatch {
  static constexpr std::size_t kSize = 64;
  // Grid coordinates of the corners, x = kOffGrid where they do not fit.
  alignas(64) glm::ivec2 p[kSize] = {}, q[kSize] = {}, r[kSize] = {};
  alignas(64) std::int32_t tile[kSize];   // out
};

// Of the first `count`.
void findSingleTiles(CornerBatch& batch, std::size_t count, const TileGrid& grid);

}  // namespace copeel::cpu
