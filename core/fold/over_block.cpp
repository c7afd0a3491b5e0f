// Dispatch; the code is in over_block-inl.h, compiled once per target.
#include "core/fold/over_block.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/fold/over_block-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/fold/over_block-inl.h"

namespace copeel::fold {

HWY_EXPORT(BlendBlock);
HWY_EXPORT(BlendColors);
HWY_EXPORT(ShadeSlots);

FoldedPixels blendBlock(const OverBlock& from, BlendedPixel* out) { return HWY_DYNAMIC_DISPATCH(BlendBlock)(from, out); }

FoldedPixels blendColors(const OverBlock& from, Rgb8* first, std::ptrdiff_t rowPixels) {
  return HWY_DYNAMIC_DISPATCH(BlendColors)(from, first, rowPixels);
}

void shadeSlots(const SlotShading& shading, std::span<const cpu::TileSlot> slots, glm::vec4* colors) {
  HWY_DYNAMIC_DISPATCH(ShadeSlots)(shading, slots, colors);
}

}  // namespace copeel::fold
