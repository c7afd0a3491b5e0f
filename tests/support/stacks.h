// The whole pixel stacks of a scene, as the tile method delivers them: groups of (primitive, side) front to back.
#pragma once

#include <limits>
#include <algorithm>
#include <mutex>
#include <vector>

#include "core/cpu/render_tiles.h"

namespace copeel::test {

struct Crossing {
  std::uint32_t primitive;
  std::int32_t side;
  friend bool operator==(const Crossing&, const Crossing&) = default;
};
using Group = std::vector<Crossing>;

inline std::size_t fragmentsOf(const std::vector<Group>& pixel) {
  std::size_t count = 0;
  for (const Group& group : pixel) count += group.size();
  return count;
}

// The K nearest fragments: within a group, which stacks hold by primitive, later ones lie in front.
inline std::vector<Group> nearest(const std::vector<Group>& pixel, std::size_t k) {
  std::vector<Group> result;
  for (const Group& group : pixel) {
    const std::size_t count = std::min(k, group.size());
    if (count == 0) break;
    result.emplace_back(group.end() - static_cast<std::ptrdiff_t>(count), group.end());
    k -= count;
  }
  return result;
}

struct Stacks {
  int width = 0, height = 0;
  std::vector<std::vector<Group>> pixels;
  std::vector<int> ends;   // how often each pixel was finished: once, whatever happens to its tile
  cpu::TileCounts counts;
  const std::vector<Group>& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
  std::size_t fragments() const {
    std::size_t count = 0;
    for (const auto& pixel : pixels) count += fragmentsOf(pixel);
    return count;
  }
};

// When a pixel has enough: after so many groups, or after one with a primitive from `opaqueFrom` on.
struct Wanted {
  std::size_t groups = ~std::size_t{0};
  std::uint32_t opaqueFrom = ~std::uint32_t{0};
};

class StackFold {
 public:
  StackFold(Stacks& stacks, Wanted wanted) : stacks_(stacks), wanted_(wanted) {}
  bool beginTile(cpu::Tile&) { return true; }
  double narrowTile(cpu::Tile&) const { return std::numeric_limits<double>::infinity(); }
  bool mayShow(std::span<const cpu::DepthRange>) const { return true; }
  cpu::DepthRange window(const PixelStack&) const { return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}; }
  bool needsWholeStack() const { return false; }
  double leastFragments() const { return 1; }
  void beginPixel(const PixelStack& stack) {
    slots_ = stack.slots;
    groups_.clear();
    open_.clear();
    opaque_ = false;
  }
  void fragment(std::uint32_t slot) { open_.push_back({slots_[slot].primitive, slots_[slot].side}); }
  bool closeGroup() {
    for (const Crossing& c : open_) opaque_ |= c.primitive >= wanted_.opaqueFrom;
    std::reverse(open_.begin(), open_.end());   // the last slot came first
    groups_.push_back(std::move(open_));
    open_.clear();
    return enough();
  }
  bool enough() const { return opaque_ || groups_.size() >= wanted_.groups; }
  void endPixels(const PixelRect& rect) {
    forEachOf(rect, [&](int x, int y) {
      const std::size_t i = static_cast<std::size_t>(y) * stacks_.width + x;
      stacks_.pixels[i] = groups_;
      ++stacks_.ends[i];
    });
  }

 private:
  Stacks& stacks_;
  Wanted wanted_;
  bool opaque_ = false;
  const cpu::TileSlot* slots_ = nullptr;
  std::vector<Group> groups_;
  Group open_;
};

inline Stacks stacksOf(const cpu::Frame& frame, const cpu::TileOptions& options = {}, Wanted wanted = {}) {
  Stacks stacks{frame.view.width, frame.view.height, {}, {}, {}};
  stacks.pixels.resize(static_cast<std::size_t>(frame.view.width) * frame.view.height);
  stacks.ends.resize(stacks.pixels.size());
  stacks.counts = cpu::renderTiles(frame, options, [&] { return StackFold(stacks, wanted); });
  return stacks;
}

}  // namespace copeel::test
