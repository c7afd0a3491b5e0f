// Transparency on the ordered fragments of a pixel, on the cpu: core/fold/over.glsl fed group by group, and where its results go.
//
// A slot's colour under the light is computed once a tile; a fragment then costs the blend alone. Alpha 0 is not seen: it hides nothing, has no depth
// and no id, but counts as a layer. Cost: 16 bytes a slot of the tile.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/cpu/tile.h"
#include "core/fold/fold.h"
#include "core/fold/over.h"
#include "core/fold/over_block.h"
#include "core/image/image.h"

namespace copeel::oit {

inline Rgb8 rgb8Of(const glm::uvec3& levels) {
  return {static_cast<std::uint8_t>(levels.x), static_cast<std::uint8_t>(levels.y), static_cast<std::uint8_t>(levels.z)};
}

// What a pixel is found to be.
struct PixelResult {
  glm::vec3 color{0};                         // 0 … 255, over the background
  Rgb8 bytes;
  const cpu::TileSlot* nearest = nullptr;     // that is seen
  std::uint32_t layers = 0;                   // fragments
  std::uint32_t largestGroup = 0;             // fragments at one depth
};

// Where a pass leaves its pixels; null: not wanted. Images start as what shows where nothing is, and a pixel with fragments is written once.
struct Targets {
  Image<Rgb8>* color = nullptr;
  Image<glm::vec3>* floats = nullptr;
  Image<float>* depth = nullptr;
  Image<std::uint16_t>* ids = nullptr;
  Image<std::uint16_t>* layers = nullptr;
  Image<std::uint16_t>* coplanar = nullptr;

  bool counts() const { return layers || coplanar; }
  bool any() const { return color || floats || depth || ids || counts(); }

  void put(const PixelRect& rect, const PixelResult& result) const {
    if (color) color->fill(rect, result.bytes);
    if (floats) floats->fill(rect, result.color);
    if (layers) layers->fill(rect, saturated(result.layers));
    if (coplanar) coplanar->fill(rect, saturated(result.largestGroup));
  }
  void putNearest(int x, int y, std::uint32_t object, double distance) const {
    if (depth) depth->at(x, y) = static_cast<float>(distance);
    if (ids) ids->at(x, y) = saturated(object + 1);
  }

 private:
  static std::uint16_t saturated(std::uint32_t value) { return static_cast<std::uint16_t>(value < 65535 ? value : 65535); }
};

class Canvas {
 public:
  Canvas(const cpu::Frame& frame, const Targets& targets) : frame_(frame), targets_(targets) {}

  void put(const PixelRect& rect, const PixelResult& result, const cpu::Tile& tile) const {
    targets_.put(rect, result);
    if (!result.nearest || !(targets_.depth || targets_.ids)) return;
    const cpu::TileSlot& slot = *result.nearest;
    forEachOf(rect, [&](int x, int y) {
      targets_.putNearest(x, y, tile.objects[slot.object].object, targets_.depth ? distanceAt(frame_.depths[slot.planeClass], frame_.view, x, y) : 0);
    });
  }
  const Targets& targets() const { return targets_; }

 private:
  const cpu::Frame& frame_;
  Targets targets_;
};

class OverFold {
 public:
  // `opaque`: per object, whether any face of it has alpha 1.
  OverFold(const cpu::Frame& frame, const fold::OverTables& tables, const std::vector<std::uint8_t>& opaque, const glm::vec3& background,
           const Canvas& canvas)
      : scene_(frame.scene), tables_(tables), opaque_(opaque), background_(background), canvas_(canvas) {}

  bool beginTile(cpu::Tile& tile);
  double narrowTile(cpu::Tile& tile);
  bool mayShow(std::span<const cpu::DepthRange>) const { return true; }
  cpu::DepthRange window(const PixelStack&) const { return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()}; }
  bool needsWholeStack() const { return false; }
  bool takesBlocks() const { return !canvas_.targets().counts(); }
  // Without an opaque face the fold never has enough, and layers are counted to the last.
  double leastFragments() const { return mayEnd_ ? 1 : std::numeric_limits<double>::infinity(); }

  void beginPixel(const PixelStack&) {
    fold::overBegin(state_);
    result_.nearest = nullptr;
    result_.layers = result_.largestGroup = 0;
    groupCount_ = 0;
    ready_ = false;
  }
  void fragment(std::uint32_t slot) {
    const glm::vec4& color = colors_[slot];
    if (!result_.nearest && color.a > 0) result_.nearest = &tile_->slots[slot];
    fold::overFragment(state_, color);
    ++groupCount_;
  }
  bool closeGroup() {
    result_.layers += groupCount_;
    result_.largestGroup = std::max(result_.largestGroup, groupCount_);
    groupCount_ = 0;
    return mayEnd_ && fold::overEnough(state_);
  }
  void endPixels(const PixelRect& rect) {
    if (result_.layers == 0) return;
    if (!ready_) finishResult();
    canvas_.put(rect, result_, *tile_);
  }

  // Whole blocks at once (core/fold/fold.h). Layers and groups are counted pixel by pixel; the z-buffer's are 1.
  FoldedPixels foldBlock(const cpu::FragmentBlock& block, const cpu::Tile& tile, std::uint64_t pixels, int x, int y);

  // The z-buffer's tile, with a fragment a pixel at most: no order is in doubt, so blocks are all it takes.
  void takeNearest(cpu::Tile& tile, std::uint64_t* keys);

 private:
  void setColor(PixelResult& result, const fold::OverState& state) const;
  void finishResult();
  const cpu::TileSlot* nearestSeen(const PixelStack& stack) const;

  const Scene& scene_;
  const fold::OverTables& tables_;
  const std::vector<std::uint8_t>& opaque_;
  glm::vec3 background_;
  const Canvas& canvas_;

  // Of the tile.
  const cpu::Tile* tile_ = nullptr;
  std::vector<fold::PrimitiveRange> ranges_;   // per object
  std::vector<glm::vec4> colors_;              // per slot, under the light
  bool mayEnd_ = false;

  // Of the pixel.
  fold::OverState state_;
  PixelResult result_;
  bool ready_ = false;                         // result_ has its colour
  std::uint32_t groupCount_ = 0;               // fragments at one depth
};

}  // namespace copeel::oit
