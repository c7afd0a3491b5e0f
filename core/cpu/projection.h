// Vertices to the sub-pixel grid, and triangles that reach behind the eye or far off the image cut to pieces that fit it.
//
// Coordinates are relative to samples: the sample of pixel (x, y) has grid coordinates (x << bits, y << bits). The grid is as fine as exact
// 32-bit edge functions inside a tile allow: 2^-12 pixel up to 1,000 pixels, 2^-8 at 16,384. 8 bytes a placed vertex, once for a mesh placed again in the same place.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "core/scene/scene.h"
#include "core/scene/view.h"
#include "core/uninitialized.h"

namespace copeel::cpu {

inline constexpr int kTileSize = 32;    // pixels
inline constexpr int kBlockSize = 8;    // pixels

struct Grid {
  int bits = 8;               // sub-pixel bits
  double guardPx = 0;         // pixels beyond each border of the image that still fit the grid
};
Grid gridFor(const View& view);

struct ClippedTriangle {
  glm::ivec2 corners[3];      // grid coordinates
  std::uint32_t primitive;
};

// A vertex that does not fit the grid has this x.
inline constexpr std::int32_t kOffGrid = INT32_MIN;

struct Projection {
  Grid grid;
  std::vector<std::uint64_t> firstVertex;      // per object, into vertices; a mesh placed again where the object before has it shares that one's
  UninitializedVector<glm::ivec2> vertices;    // grid coordinates, x = kOffGrid where they do not fit
  std::vector<std::uint8_t> reachesEye;        // per object: it has vertices nearer than nearDistance (perspective only)
};

Projection project(const Scene& scene, const View& view);

// Appends the pieces of a triangle of which a vertex is off the grid; none if it is out of sight. Adjacent triangles get the same corners on
// their common edge, so that the pieces stay watertight.
void clipTriangle(const Scene& scene, const View& view, const Grid& grid, std::uint32_t object, std::uint32_t primitive,
                  std::vector<ClippedTriangle>& pieces);

}  // namespace copeel::cpu
