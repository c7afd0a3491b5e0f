#include "apps/oit/over_fold.h"

#include <algorithm>
#include <bit>

namespace copeel::oit {

bool OverFold::beginTile(cpu::Tile& tile) {
  tile_ = &tile;
  mayEnd_ = false;
  for (const cpu::TileObject& object : tile.objects) mayEnd_ |= opaque_[object.object] != 0;
  mayEnd_ = mayEnd_ && !canvas_.targets().counts();
  return !tile.objects.empty();
}

double OverFold::narrowTile(cpu::Tile& tile) {
  ranges_.clear();
  for (const cpu::TileObject& object : tile.objects) {
    const fold::BaseRange& range = tables_.ranges[object.object];
    ranges_.push_back({range.first - range.stride * scene_.firstPrimitive(object.object), range.stride});
  }
  colors_.resize(std::max(colors_.size(), tile.slots.size()));
  fold::shadeSlots({tables_.bases.data(), tables_.shades.data(), ranges_.data()}, tile.slots, colors_.data());
  return std::numeric_limits<double>::infinity();
}

inline void OverFold::setColor(PixelResult& result, const fold::OverState& state) const {
  const glm::dvec3 color = fold::overResult(state, background_);
  result.color = glm::vec3(color);
  result.bytes = rgb8Of(fold::overLevels(color));
}

void OverFold::finishResult() {
  setColor(result_, state_);
  ready_ = true;
}

FoldedPixels OverFold::foldBlock(const cpu::FragmentBlock& block, const cpu::Tile& tile, std::uint64_t pixels, int x, int y) {
  const Targets& targets = canvas_.targets();
  const fold::OverBlock from{block, tile, pixels, colors_.data(), background_, mayEnd_};
  const bool wantsNearest = targets.depth || targets.ids;
  if (targets.color && !targets.floats && !wantsNearest && !targets.counts()) {
    return fold::blendColors(from, &targets.color->at(x, y), targets.color->width);
  }
  fold::BlendedPixel blended[cpu::kBlockPixels];
  const FoldedPixels found = fold::blendBlock(from, blended);
  for (std::uint64_t left = found.folded; left; left &= left - 1) {
    const int p = std::countr_zero(left);
    const fold::BlendedPixel& pixel = blended[p];
    PixelResult result;
    result.color = {pixel.color[0], pixel.color[1], pixel.color[2]};
    result.bytes = pixel.rgb8();
    result.layers = result.largestGroup = 1;   // wanted of the z-buffer alone
    if (wantsNearest) result.nearest = nearestSeen(stackOf(block, p, tile));
    canvas_.put({x + p % cpu::kBlockSize, y + p / cpu::kBlockSize, 1, 1}, result, tile);
  }
  return found;
}

// Of an ordered pixel: the first fragment that is not quite clear.
const cpu::TileSlot* OverFold::nearestSeen(const PixelStack& stack) const {
  for (std::uint32_t i = 0; i < stack.count; ++i) {
    if (colors_[stack.slot(i)].a > 0) return &stack.slots[stack.slot(i)];
  }
  return nullptr;
}

void OverFold::takeNearest(cpu::Tile& tile, std::uint64_t* keys) {
  beginTile(tile);
  narrowTile(tile);
  for (int b = 0; b < cpu::kBlocksPerTile; ++b, keys += cpu::kBlockPixels) {
    std::uint32_t counts[cpu::kBlockPixels];
    for (int p = 0; p < cpu::kBlockPixels; ++p) counts[p] = keys[p] != cpu::kEmptyKey;
    if (std::all_of(counts, counts + cpu::kBlockPixels, [](std::uint32_t count) { return count == 0; })) continue;
    const int x = b % cpu::kBlocksPerSide * cpu::kBlockSize, y = b / cpu::kBlocksPerSide * cpu::kBlockSize;
    foldBlock({keys, counts, cpu::kBlockPixels}, tile, ~std::uint64_t{0}, tile.x0 + x, tile.y0 + y);
  }
}

}  // namespace copeel::oit
