// Walks the sorted keys of a pixel, forms coplanar groups and feeds them to a fold. Where the keys cannot tell two classes apart, the pixel is
// ordered exactly and walked again.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/coplanarity/exact_order.h"
#include "core/fold/fold.h"

namespace copeel::cpu {

struct WalkCounts {
  std::uint64_t decidedExactly = 0;
  std::uint64_t coplanarPixels = 0;
};

inline constexpr std::uint32_t kAllFragments = ~std::uint32_t{0};

enum class Walk { Finished, NeedsMore };

// Orders a pixel whose depths are not all certain. Reused between pixels to keep its memory.
class ExactStack {
 public:
  struct Entry {
    std::uint32_t slot;
    std::uint32_t group;   // equal at one depth, ascending
  };
  // Fills `entries` front to back; `x`, `y` are image coordinates.
  void order(const PixelStack& stack, const ExactOrder& exact, int x, int y, WalkCounts& counts);
  const std::vector<Entry>& entries() const { return entries_; }

 private:
  void orderCluster(const PixelStack& stack, std::uint32_t begin, std::uint32_t end, const ExactOrder& exact, int x, int y,
                    WalkCounts& counts);

  struct Class {
    std::uint32_t planeClass;
    std::uint64_t depth, uncertainty;
    std::uint32_t group = 0;
  };
  std::vector<Entry> entries_;
  std::vector<std::uint64_t> nearestFrom_;   // least lower bound of all fragments from here on
  std::vector<Class> classes_;
  std::uint32_t groups_ = 0;
};

// Walks pixels of one tile. Neighbouring pixels mostly meet the same triangles in the same order: then the fold's state at the end of the last
// pixel is that of this one too, and the fold is not asked again.
template <Fold F>
class Walker {
 public:
  // Of a pixel with more than `most` fragments, the fold is given the nearest.
  Walker(F& fold, const ExactOrder& exact, std::uint32_t most = kAllFragments) : fold_(fold), exact_(exact), most_(most) {}

  // `limit`: fragments at or beyond this depth may be missing yet.
  void begin(const Tile& tile, std::uint64_t limit) {
    coarse_ = tile.coarse;
    uncertainty_ = tile.keys.format.uncertainty;
    limit_ = limit;
    remembers_ = false;
  }

  // On Finished the fold holds the pixel's result. `x`, `y` are image coordinates.
  Walk walk(const PixelStack& stack, int x, int y) {
    const bool exactly = stack.count > most_ || (coarse_ && stack.hasCoarse());
    const bool repeated = !exactly && remembers_ && repeats(stack);
    if (!repeated) remembers_ = false;
    const Walk outcome = repeated ? Walk::Finished : exactly ? walkExactly(stack, x, y) : walkCertain(stack, x, y);
    counts_.coplanarPixels += outcome == Walk::Finished && coplanar_;
    return outcome;
  }
  // The last pixel tells others of the same fragments.
  bool remembers() const { return remembers_; }
  void repeat(std::uint64_t pixels) { counts_.coplanarPixels += coplanar_ ? pixels : 0; }
  const WalkCounts& counts() const { return counts_; }

 private:
  // True when the pixel starts with the fragments that decided the last one, its groups as certainly apart.
  bool repeats(const PixelStack& stack) const {
    const auto count = static_cast<std::uint32_t>(met_.size());
    if (!std::equal(before_.begin(), before_.end(), stack.before.begin(), stack.before.end())) return false;
    if (enough_ ? stack.count < count : stack.count != count) return false;
    std::uint64_t last = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::uint64_t key = stack.key(i), depth = stack.format.depthOf(key);
      if (stack.format.slotOf(key) != met_[i].slot) return false;
      if (met_[i].opensGroup && i > 0 && depth <= last + 2 * uncertainty_) return false;
      last = depth;
    }
    if (count < stack.count && stack.format.depthOf(stack.key(count)) <= last + 2 * uncertainty_) return false;
    return limit_ == kNoLimit || last + uncertainty_ < limit_;
  }

  Walk walkCertain(const PixelStack& stack, int x, int y) {
    fold_.beginPixel(stack);
    met_.clear();
    before_.assign(stack.before.begin(), stack.before.end());
    coplanar_ = enough_ = false;
    for (std::uint32_t i = 0; i < stack.count && !enough_;) {
      const std::uint32_t begin = i, planeClass = stack.slots[stack.slot(i)].planeClass;
      const std::uint64_t depth = stack.format.depthOf(stack.key(i));
      if (limit_ != kNoLimit && depth + uncertainty_ >= limit_) return Walk::NeedsMore;
      for (; i < stack.count; ++i) {
        const std::uint64_t key = stack.key(i);
        const std::uint32_t slot = stack.format.slotOf(key);
        if (i > begin) {
          if (stack.format.depthOf(key) > depth + 2 * uncertainty_) break;
          // The keys leave open which of two planes is nearer.
          if (stack.slots[slot].planeClass != planeClass) return walkExactly(stack, x, y);
        }
        fold_.fragment(slot);
        met_.push_back({slot, i == begin});
      }
      coplanar_ |= i - begin > 1;
      enough_ = fold_.closeGroup();
    }
    if (limit_ != kNoLimit && !enough_) return Walk::NeedsMore;
    remembers_ = !fold_.needsWholeStack();
    return Walk::Finished;
  }

  Walk walkExactly(const PixelStack& stack, int x, int y) {
    // Missing fragments would have to be there first.
    if (limit_ != kNoLimit) return Walk::NeedsMore;
    exactStack_.order(stack, exact_, x, y, counts_);
    const std::vector<ExactStack::Entry>& entries = exactStack_.entries();
    fold_.beginPixel(stack);
    coplanar_ = enough_ = false;
    std::size_t left = most_;
    for (std::size_t i = 0; i < entries.size() && left > 0 && !enough_;) {
      const std::size_t begin = i;
      for (; i < entries.size() && left > 0 && entries[i].group == entries[begin].group; ++i, --left) fold_.fragment(entries[i].slot);
      coplanar_ |= i - begin > 1;
      enough_ = fold_.closeGroup();
    }
    return Walk::Finished;
  }

  struct Met {
    std::uint32_t slot;
    bool opensGroup;
  };

  F& fold_;
  const ExactOrder& exact_;
  std::uint32_t most_;
  ExactStack exactStack_;
  WalkCounts counts_;
  bool coarse_ = false;
  std::uint64_t uncertainty_ = 0;   // of all slots but the coarse, key units
  std::uint64_t limit_ = kNoLimit;
  std::vector<std::uint32_t> before_;   // of the last pixel, while `remembers_`
  std::vector<Met> met_;            // what it walked
  bool remembers_ = false, coplanar_ = false, enough_ = false;
};

}  // namespace copeel::cpu
