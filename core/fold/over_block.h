// The fold of transparency on a block of 8×8 pixels at once: core/fold/over.glsl's operations in its order, so the same bits, vectorised over the
// channels with run-time dispatch. For pixels whose sorted keys tell their order. Slots of a tile are shaded so, too.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/cpu/tile.h"
#include "core/fold/fold.h"
#include "core/image/image.h"

namespace copeel::fold {

// Where the colours of an object's primitives lie: bases[first + stride · primitive], modulo 2^32.
struct PrimitiveRange {
  std::uint32_t first, stride;
};

struct SlotShading {
  const glm::vec4* bases;
  const float* shades;             // per plane class
  const PrimitiveRange* ranges;    // per object of the tile
};

// overShade of each slot; as many colours.
void shadeSlots(const SlotShading& shading, std::span<const cpu::TileSlot> slots, glm::vec4* colors);

struct BlendedPixel {
  float color[4];          // 0 … 255 over the background; the last is undefined
  std::uint8_t bytes[4];   // of the colour

  Rgb8 rgb8() const { return {bytes[0], bytes[1], bytes[2]}; }
};

struct OverBlock {
  cpu::FragmentBlock block;  // sorted
  const cpu::Tile& tile;
  std::uint64_t pixels;      // that are wanted, a bit each
  const glm::vec4* colors;   // per slot, 0 … 255 and alpha
  glm::vec3 background;      // 0 … 255
  bool mayEnd;               // some colour is opaque: what lies behind it is not met
};

// Blends the wanted pixels that have fragments and whose keys tell the order of those that are met: all that have a single one; none with a slot that is
// coarse (cpu::Tile) among several.
FoldedPixels blendBlock(const OverBlock& from, BlendedPixel* out);

// The same to an image, whose rows are `rowPixels` long. first: the block's first pixel in it.
FoldedPixels blendColors(const OverBlock& from, Rgb8* first, std::ptrdiff_t rowPixels);

}  // namespace copeel::fold
