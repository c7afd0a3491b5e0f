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

inline bool hasCoarse(const PixelStack& stack) {
  for (std::uint32_t i = 0; i < stack.count; ++i) {
    if (stack.slots[stack.slot(i)].uncertainty > Tile::kCoarse) return true;
  }
  return false;
}

// `coarse`: the tile has coarse slots. `limit`: fragments at or beyond this depth may be missing yet; ~0 when none is.
template <Fold F>
Walk walkExactly(F& fold, const PixelStack& stack, const std::vector<ExactStack::Entry>& entries, WalkCounts& counts) {
  fold.beginPixel(stack);
  bool coplanar = false, enough = false;
  for (std::size_t i = 0; i < entries.size() && !enough;) {
    const std::size_t begin = i;
    for (; i < entries.size() && entries[i].group == entries[begin].group; ++i) fold.fragment(entries[i].slot);
    coplanar |= i - begin > 1;
    enough = fold.closeGroup();
  }
  counts.coplanarPixels += coplanar;
  return Walk::Finished;
}

template <Fold F>
Walk walkPixel(F& fold, const PixelStack& stack, bool coarse, std::uint64_t limit, int x, int y, const ExactOrder& exact, ExactStack& exactStack,
               WalkCounts& counts) {
  if (coarse && hasCoarse(stack)) {
    if (limit != ~std::uint64_t{0}) return Walk::NeedsMore;
    exactStack.order(stack, exact, x, y, counts);
    return walkExactly(fold, stack, exactStack.entries(), counts);
  }
  fold.beginPixel(stack);
  bool coplanar = false;
  for (std::uint32_t i = 0; i < stack.count;) {
    const std::uint64_t key = stack.key(i);
    const TileSlot& first = stack.slots[stack.format.slotOf(key)];
    const std::uint64_t depth = stack.format.depthOf(key);
    if (depth + first.uncertainty >= limit) return Walk::NeedsMore;
    fold.fragment(stack.format.slotOf(key));
    const std::uint32_t begin = i++;
    for (; i < stack.count; ++i) {
      const std::uint64_t next = stack.key(i);
      const TileSlot& slot = stack.slots[stack.format.slotOf(next)];
      if (stack.format.depthOf(next) > depth + first.uncertainty + slot.uncertainty) break;
      if (slot.planeClass != first.planeClass) {
        // The keys leave open which of two planes is nearer. Missing fragments would have to be there first.
        if (limit != ~std::uint64_t{0}) return Walk::NeedsMore;
        exactStack.order(stack, exact, x, y, counts);
        return walkExactly(fold, stack, exactStack.entries(), counts);
      }
      fold.fragment(stack.format.slotOf(next));
    }
    coplanar |= i - begin > 1;
    if (fold.closeGroup()) break;
  }
  if (limit != ~std::uint64_t{0} && !fold.enough()) return Walk::NeedsMore;
  counts.coplanarPixels += coplanar;
  return Walk::Finished;
}

}  // namespace copeel::cpu
