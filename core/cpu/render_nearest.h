// The plain z-buffer pass: the same set-up, coverage and depth as the tile method, keeping one fragment a pixel. The yardstick of every frame.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "core/cpu/frame.h"
#include "core/cpu/tile.h"

namespace copeel::cpu {

// `visit(x, y, const TileSlot*, const Tile&)`: for every pixel the nearest triangle's slot, or null. Called from several threads.
template <class Visit>
void renderNearest(const Frame& frame, Visit visit) {
  struct Local {
    Tile tile;
    std::vector<std::uint64_t> nearest = std::vector<std::uint64_t>(kBlocksPerTile * kBlockPixels);
  };
  tbb::enumerable_thread_specific<Local> locals;
  tbb::parallel_for(tbb::blocked_range<int>(0, frame.tileCount(), 1), [&](const auto& range) {
    Local& local = locals.local();
    for (int i = range.begin(); i != range.end(); ++i) {
      Tile& tile = local.tile;
      tile.begin(frame, i);
      tile.setUp(frame);
      tile.finish(frame, std::numeric_limits<double>::infinity(), false);
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
  }, tbb::simple_partitioner());
}

}  // namespace copeel::cpu
