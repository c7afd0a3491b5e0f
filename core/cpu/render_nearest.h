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

// `visit(x, y, const TileSlot&, const Tile&)`: the slot of the nearest triangle of each pixel that has any. Called from several threads.
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
      collectNearest(tile.setups, tile.format, local.nearest.data());
      for (int b = 0; b < kBlocksPerTile; ++b) {
        const int x0 = b % kBlocksPerSide * kBlockSize, y0 = b / kBlocksPerSide * kBlockSize;
        for (int p = 0; p < kBlockPixels; ++p) {
          const std::uint64_t key = local.nearest[b * kBlockPixels + p];
          if (key == kEmptyKey) continue;
          visit(tile.x0 + x0 + p % kBlockSize, tile.y0 + y0 + p / kBlockSize, tile.slots[tile.format.slotOf(key)], tile);
        }
      }
    }
  }, Split::ToGrain);
}

}  // namespace copeel::cpu
