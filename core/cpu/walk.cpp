// Exact ordering of a pixel: clusters of fragments whose depth intervals chain together are ordered by class, equal depths share a group.
#include "core/cpu/walk.h"

namespace copeel::cpu {

void ExactStack::order(const PixelStack& stack, const ExactOrder& exact, int x, int y, WalkCounts& counts) {
  entries_.clear();
  groups_ = 0;
  nearestFrom_.assign(stack.count + 1, ~std::uint64_t{0});
  for (std::uint32_t i = stack.count; i-- > 0;) {
    const std::uint64_t depth = stack.format.depthOf(stack.key(i)), uncertainty = stack.uncertaintyOf(stack.slot(i));
    nearestFrom_[i] = std::min(nearestFrom_[i + 1], depth > uncertainty ? depth - uncertainty : 0);
  }
  for (std::uint32_t i = 0; i < stack.count;) {
    const std::uint32_t begin = i;
    std::uint64_t reach = 0;
    do {
      reach = std::max(reach, stack.format.depthOf(stack.key(i)) + stack.uncertaintyOf(stack.slot(i)));
      ++i;
    } while (i < stack.count && nearestFrom_[i] <= reach);
    orderCluster(stack, begin, i, exact, x, y, counts);
  }
}

void ExactStack::orderCluster(const PixelStack& stack, std::uint32_t begin, std::uint32_t end, const ExactOrder& exact, int x, int y,
                              WalkCounts& counts) {
  if (end - begin == 1) {
    entries_.push_back({stack.slot(begin), groups_++});
    return;
  }
  // One entry per class; fragments of a class have one depth.
  classes_.clear();
  for (std::uint32_t i = begin; i < end; ++i) {
    const TileSlot& slot = stack.slots[stack.slot(i)];
    classes_.push_back({slot.planeClass, stack.format.depthOf(stack.key(i)), stack.uncertaintyOf(stack.slot(i))});
  }
  std::sort(classes_.begin(), classes_.end(), [](const Class& a, const Class& b) { return a.planeClass < b.planeClass; });
  classes_.erase(std::unique(classes_.begin(), classes_.end(), [](const Class& a, const Class& b) { return a.planeClass == b.planeClass; }),
                 classes_.end());

  const auto compare = [&](const Class& a, const Class& b) {
    const std::uint64_t gap = a.depth > b.depth ? a.depth - b.depth : b.depth - a.depth;
    if (gap > a.uncertainty + b.uncertainty) return a.depth < b.depth ? -1 : 1;
    ++counts.decidedExactly;
    return exact.compare(a.planeClass, b.planeClass, x, y);
  };
  std::sort(classes_.begin(), classes_.end(), [&](const Class& a, const Class& b) { return compare(a, b) < 0; });
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    if (k > 0 && compare(classes_[k - 1], classes_[k]) != 0) ++groups_;
    classes_[k].group = groups_;
  }
  ++groups_;
  std::sort(classes_.begin(), classes_.end(), [](const Class& a, const Class& b) { return a.planeClass < b.planeClass; });

  // Fragments by group, and from the last slot to the first within one.
  const std::size_t first = entries_.size();
  for (std::uint32_t i = begin; i < end; ++i) {
    const std::uint32_t slot = stack.slot(i);
    const auto found = std::lower_bound(classes_.begin(), classes_.end(), stack.slots[slot].planeClass,
                                        [](const Class& c, std::uint32_t id) { return c.planeClass < id; });
    entries_.push_back({slot, found->group});
  }
  std::sort(entries_.begin() + static_cast<std::ptrdiff_t>(first), entries_.end(), [](const Entry& a, const Entry& b) {
    return a.group != b.group ? a.group < b.group : a.slot > b.slot;
  });
}

}  // namespace copeel::cpu
