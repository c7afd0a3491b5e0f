// The cpu back end's frame: every tile is set up, its fragments collected, sorted and given to a fold, tiles in parallel.
//
// Tiles whose fragments outgrow the memory budget are split into blocks of 8×8 pixels; tiles of many triangles are met front to back in
// growing batches and left as soon as every pixel has had enough. The result does not depend on threads, splits or batches.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>

#include <tbb/enumerable_thread_specific.h>

#include "core/cpu/block_order.h"
#include "core/cpu/block_window.h"
#include "core/cpu/even_block.h"
#include "core/cpu/walk.h"
#include "core/error.h"
#include "core/parallel.h"

namespace copeel::cpu {

struct TileCounts {
  WalkCounts walk;
  std::uint64_t fragments = 0, captured = 0;
  std::uint64_t depthComplexityMax = 0;
  std::uint64_t coveredPixels = 0;
};

struct TileOptions {
  std::size_t gridBudgetBytes = std::size_t{16} << 20;   // per thread; a single block may exceed it
  bool decideAllExactly = false;
  std::uint32_t nearest = kAllFragments;                 // how many of a pixel the fold is given: 1 or more
};

// A tile is met in batches when it has many times the layers that a fold needs at least. Each batch repeats the fold of the
// pixels that the one before left open, so batches grow fast.
inline constexpr double kBatchesFrom = 8, kBatchGrowth = 4;

// Layers of a tile from which on ordering them all costs more than finding out which need it.
inline constexpr double kNarrowFrom = 8;

// Samples of a triangle from which on ordering triangles by depth saves a k-buffer more than it costs.
inline constexpr double kSamplesToOrder = 16;

// Samples of a triangle from which on blocks are looked at that faces cover wholly.
inline constexpr double kSamplesOfLargeFace = 4 * kBlockPixels;

// Draws tiles with one fold. Owned by one thread.
template <Fold F>
class TileRenderer {
 public:
  TileRenderer(const Frame& frame, const TileOptions& options, F fold)
      : frame_(frame), options_(options), fold_(std::move(fold)), grid_(options.gridBudgetBytes), nearest_(options.nearest),
        exact_(frame.scene, frame.planes, frame.depths, frame.view), walker_(fold_, exact_, options.nearest) {}
  TileRenderer(const TileRenderer&) = delete;

  void draw(int index) {
    tile_.begin(frame_, index);
    if (!fold_.beginTile(tile_)) return;
    if (keepsNearest()) keepAll();
    tile_.setUp(frame_);
    const double farthest = fold_.narrowTile(tile_);
    if (farthest == -std::numeric_limits<double>::infinity()) return;
    std::fill(std::begin(done_), std::end(done_), 0);
    if (keepsNearest()) return drawNearest();
    // Where a single fragment may be enough, or never any, or few lie upon each other, narrowing is not worth its time.
    const double least = fold_.leastFragments();
    narrows_ = least >= 2 && least < std::numeric_limits<double>::infinity() && tile_.layers() >= kNarrowFrom;
    finished_ = narrows_ ? emptyBlocks() : 0;
    if (finished_ == kAllBlocks) return;
    tile_.finish(farthest, options_.decideAllExactly);
    if (narrows_) tile_.orderBySlot();
    if (hasLargeFaces()) drawEvenBlocks();
    if (finished_ != kAllBlocks) drawRect(wholeTile());
  }
  TileCounts counts() const {
    TileCounts counts = counts_;
    counts.walk = walker_.counts();
    counts.walk.coplanarPixels += coplanarPixels_;
    return counts;
  }

 private:
  static constexpr std::uint32_t kAllBlocks = (1u << kBlocksPerTile) - 1;

  // The blocks in which the fold sees that nothing shows.
  std::uint32_t emptyBlocks() {
    tile_.rangesOfBlocks(ranges_);
    const std::size_t count = tile_.objects.size();
    std::uint32_t empty = 0;
    for (int b = 0; b < kBlocksPerTile; ++b) empty |= std::uint32_t{!fold_.mayShow({ranges_.data() + b * count, count})} << b;
    return empty;
  }

  BlockRect wholeTile() const {
    return {0, 0, (tile_.width + kBlockSize - 1) / kBlockSize, (tile_.height + kBlockSize - 1) / kBlockSize};
  }
  // Of the image.
  PixelRect pixelsOf(int block) const {
    const int x = block % kBlocksPerSide * kBlockSize, y = block / kBlocksPerSide * kBlockSize;
    return {tile_.x0 + x, tile_.y0 + y, std::min(kBlockSize, tile_.width - x), std::min(kBlockSize, tile_.height - y)};
  }

  bool hasLargeFaces() const {
    const double samples = tile_.layers() * tile_.width * tile_.height;
    return !tile_.coarse && !fold_.needsWholeStack() && samples >= kSamplesOfLargeFace * static_cast<double>(tile_.setups.size());
  }

  void drawEvenBlocks() {
    walker_.begin(tile_, kNoLimit);
    const BlockRect rect = wholeTile();
    for (int by = rect.by0; by < rect.by1; ++by) {
      for (int bx = rect.bx0; bx < rect.bx1; ++bx) {
        const int b = by * kBlocksPerSide + bx;
        const PixelRect pixels = pixelsOf(b);
        if (finished_ >> b & 1 || !even_.find(tile_, pixels)) continue;
        finished_ |= 1u << b;
        if (even_.empty()) continue;
        const PixelStack stack = even_.stack(tile_);
        walker_.walk(stack, pixels.x, pixels.y);
        endAll(pixels);
        std::uint32_t counts[kBlockPixels] = {};
        std::fill_n(counts, pixels.width * pixels.height, stack.count);
        countFragments(counts);
      }
    }
  }

  bool keepsNearest() const { return options_.nearest != kAllFragments; }
  void keepAll() {
    for (TileObject& object : tile_.objects) object.keep = true;
  }

  // Which fragments are the nearest must not depend on what the fold has no use for in this tile: nothing is left out. Where depths are too
  // uncertain for keys to choose, or the fold wants whole stacks, all fragments are ordered and the nearest given to the fold.
  void drawNearest() {
    keepAll();
    tile_.finish(std::numeric_limits<double>::infinity(), options_.decideAllExactly);
    finished_ = 0;
    narrows_ = false;
    const BlockRect rect = wholeTile();
    if (tile_.coarse || fold_.needsWholeStack()) return drawRect(rect);
    const KeyDoubt doubt{tile_.keys.format.reach(), tile_.slots.data()};
    nearest_.clear();
    // Met nearest first, most fragments turn back at once; of small triangles the order costs more than it saves.
    const double layers = tile_.layers();
    if (layers > 2.0 * options_.nearest && layers * tile_.width * tile_.height > kSamplesToOrder * static_cast<double>(tile_.setups.size())) tile_.orderByDepth();
    collectKNearest(tile_.setups, tile_.keys, doubt, nearest_);
    for (int by = rect.by0; by < rect.by1; ++by) {
      for (int bx = rect.bx0; bx < rect.bx1; ++bx) foldNearest(bx, by);
    }
  }

  void foldNearest(int bx, int by) {
    NearestGrid::Block& nearest = nearest_.block(by * kBlocksPerSide + bx);
    const FragmentBlock kept = nearest.kept();
    for (int p = 0; p < kBlockPixels && !nearest.doubtful; ++p) {
      if (nearest.seen[p] > kept.counts[p] && endsOpen(kept, p)) nearest.doubtful = 1;
    }
    if (nearest.doubtful) return drawRect({bx, by, bx + 1, by + 1});
    countFragments(nearest.seen);
    foldBlock(kept, by * kBlocksPerSide + bx, kNoLimit);
  }

  // True where the last that was kept may in truth be nearer than one of another plane before it: then what was lost may be, too.
  bool endsOpen(const FragmentBlock& kept, int p) const {
    const PixelStack stack = stackOf(kept, p, tile_);
    const std::uint32_t last = stack.count - 1, planeClass = tile_.slots[stack.slot(last)].planeClass;
    const std::uint64_t depth = tile_.keys.format.depthOf(stack.key(last));
    for (std::uint32_t i = last; i-- > 0 && tile_.keys.format.depthOf(stack.key(i)) + 2 * tile_.keys.format.uncertainty >= depth;) {
      if (tile_.slots[stack.slot(i)].planeClass != planeClass) return true;
    }
    return false;
  }

  void drawRect(const BlockRect& rect) {
    if (tile_.setups.empty()) return;
    grid_.begin(rect);
    double layers = fold_.needsWholeStack() ? 0 : 2 + 2 * fold_.leastFragments();
    const bool batches = layers > 0 && !keepsNearest() && tile_.layers() > kBatchesFrom * layers;
    if (batches && tile_.nearest.empty()) tile_.orderByDepth();
    narrows_ &= tile_.nearest.empty();   // windows want the order of slots
    const std::span<const TriangleSetup> all = tile_.setups;
    for (std::size_t begin = 0;; layers *= kBatchGrowth) {
      const std::size_t end = batches ? std::max(tile_.setupsOfLayers(layers), begin) : all.size();
      if (!collectFragments(all.subspan(begin, end - begin), tile_.keys, rect, finished_, grid_)) return split(rect);
      const bool last = end == all.size();
      if (foldRect(rect, last ? kNoLimit : tile_.nearest[end]) || last) break;
      begin = end;
    }
    countFragments(grid_.counts());
  }

  // counts: of some blocks.
  void countFragments(std::span<const std::uint32_t> counts) {
    const PixelCounts found = countPixels(counts, options_.nearest);
    counts_.fragments += found.fragments;
    counts_.captured += found.captured;
    counts_.coveredPixels += found.covered;
    counts_.depthComplexityMax = std::max<std::uint64_t>(counts_.depthComplexityMax, found.most);
  }

  void split(const BlockRect& rect) {
    // What the grid could not take is drawn block by block; blocks and pixels that an earlier batch finished stay as they are.
    for (int b = 0; b < kBlocksPerTile; ++b) {
      if (finished_ >> b & 1) countFragments(grid_.counts().subspan(static_cast<std::size_t>(b) * kBlockPixels, kBlockPixels));
    }
    for (int by = rect.by0; by < rect.by1; ++by) {
      for (int bx = rect.bx0; bx < rect.bx1; ++bx) {
        if (finished_ >> (by * kBlocksPerSide + bx) & 1) continue;
        drawRect({bx, by, bx + 1, by + 1});
      }
    }
  }

  // True when every pixel of the rectangle has had enough.
  bool foldRect(const BlockRect& rect, std::uint64_t limit) {
    bool all = true;
    for (int by = rect.by0; by < rect.by1; ++by) {
      for (int bx = rect.bx0; bx < rect.bx1; ++bx) {
        const int b = by * kBlocksPerSide + bx;
        if (finished_ >> b & 1) continue;
        // A pixel that no fragment is left to meet shows nothing, and its fold is not asked.
        const bool isEmpty = limit == kNoLimit && grid_.block(b).empty();
        if (isEmpty || foldBlock(sorted(narrowed(b)), b, limit)) finished_ |= 1u << b;
        else all = false;
      }
    }
    return all;
  }

  // What of a block's fragments is to be ordered.
  FragmentBlock narrowed(int b) {
    const FragmentBlock all = grid_.block(b);
    if (!narrows_) return all;
    window_.take(fold_, tile_, all);
    return window_.block();
  }

  static FragmentBlock sorted(const FragmentBlock& block) {
    sortBlock(block);
    return block;
  }

  // Folds the pixels at once whose order the keys tell, if the fold knows how to.
  void foldCertain(const FragmentBlock& block, int b, int x, int y) {
    if constexpr (requires { fold_.takesBlocks(); }) {
      if (!fold_.takesBlocks()) return;
      const FoldedPixels pixels = fold_.foldBlock(block, tile_, ~done_[b], x, y);
      coplanarPixels_ += std::popcount(pixels.coplanar);
      done_[b] |= pixels.folded;
    }
  }

  // block: sorted. True when each of its pixels has had enough.
  bool foldBlock(const FragmentBlock& block, int b, std::uint64_t limit) {
    const auto [x, y, columns, rows] = pixelsOf(b);
    walker_.begin(tile_, limit);
    const bool whole = limit == kNoLimit && !keepsNearest() && !narrows_;
    if (whole) foldCertain(block, b, x, y);
    const bool alike = whole && !done_[b] && sameStacks(block, tile_);
    const std::uint64_t inImage = 0x0101010101010101ull * (0xFFu >> (kBlockSize - columns)) & ~std::uint64_t{0} >> (kBlockPixels - rows * kBlockSize);
    bool all = true;
    for (std::uint64_t left = inImage & ~done_[b]; left; left &= left - 1) {
      const int p = std::countr_zero(left), column = p % kBlockSize, row = p / kBlockSize;
      if (block.counts[p] == 0 && limit == kNoLimit) continue;
      PixelStack stack = stackOf(block, p, tile_);
      if (narrows_) stack.before = window_.before(p);
      if (walker_.walk(stack, x + column, y + row) == Walk::Finished) {
        if (alike && p == 0 && walker_.remembers()) {
          endAll({x, y, columns, rows});
          return true;
        }
        fold_.endPixels({x + column, y + row, 1, 1});
        done_[b] |= std::uint64_t{1} << p;
      } else {
        all = false;
      }
    }
    return all;
  }

  // All pixels of a block are as the first, which has been walked.
  void endAll(const PixelRect& block) {
    walker_.repeat(static_cast<std::uint64_t>(block.width) * block.height - 1);
    fold_.endPixels(block);
  }

  const Frame& frame_;
  TileOptions options_;
  F fold_;
  Tile tile_;
  FragmentGrid grid_;
  NearestGrid nearest_;
  ExactOrder exact_;
  Walker<F> walker_;
  std::uint64_t done_[kBlocksPerTile] = {};   // pixels, by block
  std::uint32_t finished_ = 0;                // blocks
  std::vector<DepthRange> ranges_;            // [block][object]
  EvenBlock even_;
  BlockWindow window_;
  bool narrows_ = false;
  TileCounts counts_;
  std::uint64_t coplanarPixels_ = 0;          // that the walker has not seen
};

// Draws all tiles; `makeFold` is called once per thread. The folds write disjoint pixels.
template <class MakeFold>
TileCounts renderTiles(const Frame& frame, const TileOptions& options, MakeFold makeFold) {
  using F = decltype(makeFold());
  tbb::enumerable_thread_specific<TileRenderer<F>> renderers([&] { return TileRenderer<F>(frame, options, makeFold()); });
  parallelFor(static_cast<std::size_t>(frame.tileCount()), 1, [&](std::size_t begin, std::size_t end) {
    TileRenderer<F>& renderer = renderers.local();
    for (std::size_t i = begin; i != end; ++i) renderer.draw(static_cast<int>(i));
  }, Split::ToGrain);
  TileCounts total;
  for (const auto& renderer : renderers) {
    const TileCounts counts = renderer.counts();
    total.fragments += counts.fragments;
    total.captured += counts.captured;
    total.depthComplexityMax = std::max(total.depthComplexityMax, counts.depthComplexityMax);
    total.coveredPixels += counts.coveredPixels;
    total.walk.decidedExactly += counts.walk.decidedExactly;
    total.walk.coplanarPixels += counts.walk.coplanarPixels;
  }
  return total;
}

}  // namespace copeel::cpu
