// Triangles to tiles: which primitives may cover a sample of which tile, in the order of their ids (sort-middle).
//
// A reference is a primitive id, or kPrimitiveLimit + index for a piece of a clipped triangle. A mesh placed again where the object before has it has
// none: its triangles lie where that one's do. 4 bytes a reference.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/cpu/projection.h"

namespace copeel::cpu {

struct Bins {
  int columns = 0, rows = 0;                  // tiles
  std::vector<std::uint64_t> first;           // per tile, and the end
  UninitializedVector<std::uint32_t> references;
  std::vector<ClippedTriangle> clipped;

  std::span<const std::uint32_t> tile(int index) const {
    return {references.data() + first[index], static_cast<std::size_t>(first[index + 1] - first[index])};
  }
};

Bins binTriangles(const Scene& scene, const View& view, const Projection& projection);

}  // namespace copeel::cpu
