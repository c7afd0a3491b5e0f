#include "apps/oit/over_fold.h"

#include <algorithm>

namespace copeel::oit {

bool OverFold::beginTile(cpu::Tile& tile) {
  tile_ = &tile;
  mayEnd_ = false;
  for (const cpu::TileObject& object : tile.objects) mayEnd_ |= opaque_[object.object] != 0;
  mayEnd_ = mayEnd_ && !canvas_.targets().counts();
  return !tile.objects.empty();
}

double OverFold::narrowTile(cpu::Tile& tile) {
  colors_.resize(std::max(colors_.size(), tile.slots.size()));
  for (std::size_t i = 0; i < tile.slots.size(); ++i) colors_[i] = colorOf(tile.slots[i], tile.objects[tile.slots[i].object].object);
  return std::numeric_limits<double>::infinity();
}

inline glm::vec4 OverFold::colorOf(const cpu::TileSlot& slot, std::uint32_t object) const {
  const fold::BaseRange& range = tables_.ranges[object];
  const std::uint32_t triangle = slot.primitive - scene_.firstPrimitive(object);
  return fold::overShade(tables_.bases[range.first + std::size_t{range.stride} * triangle], tables_.shades[slot.planeClass]);
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

PixelResult OverFold::single(const cpu::TileSlot& slot, const cpu::Tile& tile) const {
  PixelResult result;
  fold::OverState state;
  fold::overBegin(state);
  const glm::vec4 color = colorOf(slot, tile.objects[slot.object].object);
  fold::overFragment(state, color);
  result.layers = result.largestGroup = 1;
  if (color.a > 0) result.nearest = &slot;
  setColor(result, state);
  return result;
}

}  // namespace copeel::oit
