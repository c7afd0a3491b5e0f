// The plain z-buffer pass: the same set-up, coverage and depth as the tile method, keeping one fragment a pixel. The yardstick of every frame.
#pragma once

#include <algorithm>
#include <limits>
#include <memory>
#include <vector>

#include <tbb/enumerable_thread_specific.h>

#include "core/cpu/frame.h"
#include "core/cpu/tile.h"
#include "core/parallel.h"

namespace copeel::cpu {

// `take(tile, keys)` for each tile, with the least key of each pixel, [block][64], or kEmptyKey. `makeTake` is called once per thread.
template <class MakeTake>
void renderNearestTiles(const Frame& frame, MakeTake makeTake) {
  struct Local {
    explicit Local(MakeTake& make) : take(make()) {}
    decltype(makeTake()) take;
    Tile tile;
    std::vector<std::uint64_t> nearest = std::vector<std::uint64_t>(kBlocksPerTile * kBlockPixels + 1);   // as FragmentBlock
  };
  tbb::enumerable_thread_specific<std::unique_ptr<Local>> locals([&] { return std::make_unique<Local>(makeTake); });
  parallelFor(static_cast<std::size_t>(frame.tileCount()), 1, [&](std::size_t begin, std::size_t end) {
    Local& local = *locals.local();
    for (std::size_t i = begin; i != end; ++i) {
      Tile& tile = local.tile;
      tile.begin(frame, static_cast<int>(i));
      if (tile.objects.empty()) continue;
      tile.setUp(frame);
      tile.finish(std::numeric_limits<double>::infinity(), false);
      std::fill(local.nearest.begin(), local.nearest.end(), kEmptyKey);
      collectNearest(tile.setups, tile.keys, local.nearest.data());
      local.take(tile, local.nearest.data());
    }
  }, Split::ToGrain);
}

// `visit(x, y, const TileSlot&, const Tile&)`: the slot of the nearest triangle of each pixel that has any. Called from several threads.
template <class Visit>
void renderNearest(const Frame& frame, const Visit& visit) {
  renderNearestTiles(frame, [&] {
    return [&](const Tile& tile, const std::uint64_t* keys) {
      for (int b = 0; b < kBlocksPerTile; ++b) {
        const int x0 = b % kBlocksPerSide * kBlockSize, y0 = b / kBlocksPerSide * kBlockSize;
        for (int p = 0; p < kBlockPixels; ++p) {
          const std::uint64_t key = keys[b * kBlockPixels + p];
          if (key == kEmptyKey) continue;
          visit(tile.x0 + x0 + p % kBlockSize, tile.y0 + y0 + p / kBlockSize, tile.slots[tile.keys.format.slotOf(key)], tile);
        }
      }
    };
  });
}

}  // namespace copeel::cpu
