// The plain z-buffer pass: the same set-up, coverage and depth as the tile method, keeping one fragment a pixel. The yardstick of every frame.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "core/cpu/frame.h"
#include "core/cpu/tile.h"
#include "core/parallel.h"

namespace copeel::cpu {

// `visit(x, y, const TileSlot*, const Tile&)`: for every pixel the nearest triangle's slot, or null. Called from several threads.
template <class Visit>
void renderNearest(const Frame& frame, Visit visit) {
  struct Local {
    Tile tile;
    std::vector<std::uint64_t> nearest = std::vector<std::uint64_t>(kBlocksPerTile * kBlockPixels);
  };
  tbb::enumerable_thread_specific<Local> locals;
  parallelFor(static_cast<std::size_t>(frame.tileCount()), 1, [&](std::size_t begin, std::size_t end) {
    Local& local = locals.local();
    for (std::size_t i = begin; i != end; ++i) {
      Tile& tile = local.tile;
      tile.begin(frame, static_cast<int>(i));
      tile.setUp(frame);
      tile.finish(std::numeric_limits<double>::infinity(), false);
      std::fill(local.nearest.begin(), local.nearest.end(), kEmptyKey);
      collectNearest(tile.setups, tile.format, BlockRect{}, local.nearest.data());
      for (int y = 0; y < tile.height; ++y) {
        for (int x = 0; x < tile.width; ++x) {
          const int block = y / kBlockSize * kBlocksPerSide + x / kBlockSize;
          const std::uint64_t key = local.nearest[block * kBlockPixels + y % kBlockSize * kBlockSize + x % kBlockSize];
          visit(tile.x0 + x, tile.y0 + y, key == kEmptyKey ? nullptr : &tile.slots[tile.format.slotOf(key)], tile);
        }
      }
    }
  }, Split::ToGrain);
}

}  // namespace copeel::cpu
