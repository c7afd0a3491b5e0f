// Corners are enough: the true depths of two planes differ by an affine function, which is positive in a rectangle if it is in its corners. Where
// a depth is clamped it is not affine.
#include "core/cpu/even_block.h"

#include <algorithm>

namespace copeel::cpu {
namespace {

enum class Cover : std::uint8_t { None, Some, All };

Cover coverOf(const TriangleSetup& t, const TileKeys& keys, const PixelRect& block) {
  const int right = block.x + block.width - 1, bottom = block.y + block.height - 1;
  if (t.x1 < block.x || t.x0 > right || t.y1 < block.y || t.y0 > bottom) return Cover::None;
  if (!t.hasEdges()) return Cover::Some;   // it is small
  // Edges that the triangle's bounds make redundant were dropped, so the bounds count.
  bool all = t.x0 <= block.x && t.x1 >= right && t.y0 <= block.y && t.y1 >= bottom;
  const TriangleEdges& edges = keys.edgesOf(t);
  for (int i = 0; i < 3; ++i) {
    const int corner = edges.a[i] * block.x + edges.b[i] * block.y + edges.c[i];
    const int across = edges.a[i] * (block.width - 1), down = edges.b[i] * (block.height - 1);
    if (corner + std::max(across, 0) + std::max(down, 0) < 0) return Cover::None;
    all &= corner + std::min(across, 0) + std::min(down, 0) >= 0;
  }
  return all ? Cover::All : Cover::Some;
}

}  // namespace

bool EvenBlock::find(const Tile& tile, const PixelRect& pixels) {
  const KeyFormat& format = tile.keys.format;
  const PixelRect block{pixels.x - tile.x0, pixels.y - tile.y0, pixels.width, pixels.height};
  layers_.clear();
  for (const TriangleSetup& t : tile.setups) {
    const Cover cover = coverOf(t, tile.keys, block);
    if (cover == Cover::Some) return false;
    if (cover == Cover::None) continue;
    Layer& layer = layers_.emplace_back();
    const DepthPlane& plane = tile.keys.planeOf(t);
    for (std::uint32_t corner = 0; corner < kCorners; ++corner) {
      const int x = corner & 1 ? block.x + block.width - 1 : block.x, y = corner & 2 ? block.y + block.height - 1 : block.y;
      const double order = orderAt(plane, tile.keys, x, y);
      if (order < plane.lo || order > plane.hi) return false;
      layer[corner] = keyAt(t, x, y, tile.keys);
    }
  }
  std::sort(layers_.begin(), layers_.end());
  for (std::size_t i = 1; i < layers_.size(); ++i) {
    const Layer &near = layers_[i - 1], &far = layers_[i];
    if (tile.slots[format.slotOf(near[0])].planeClass == tile.slots[format.slotOf(far[0])].planeClass) continue;
    for (std::uint32_t corner = 0; corner < kCorners; ++corner) {
      if (format.depthOf(far[corner]) <= format.depthOf(near[corner]) + 2 * format.uncertainty) return false;
    }
  }
  return true;
}

}  // namespace copeel::cpu
