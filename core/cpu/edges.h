// Triangles of a tile on their way from corners and planes to edges, slots and setups, in batches, vectorised across triangles with run-time dispatch.
//
// Edges are exact: corners differ by less than 2^24 grid steps, so products stay below 2^48 and sums below 2^51, which a double holds to
// the last unit, as it does their division by a power of two. Every target therefore gives the same integers. Edges are Pineda's. A parallel
// algorithm for polygon rasterization. SIGGRAPH 1988.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/cpu/kernels.h"

namespace copeel::cpu {

inline constexpr int kEdgeBatch = 32;   // triangles; a bit each, and a multiple of every target's lanes

// Of some triangles together.
struct DepthExtent {
  double least = std::numeric_limits<double>::infinity(), most = -least;   // order values, without their errors
  double leastError = least, mostError = 0;
  std::int64_t samples = 0;                                               // EdgeBatch::samples
  void add(double from, double to, double error, std::int64_t count) {
    least = std::min(least, from), most = std::max(most, to);
    leastError = std::min(leastError, error), mostError = std::max(mostError, error);
    samples += count;
  }
};

struct EdgeBatch {
  // In: corners, grid coordinates.
  alignas(64) glm::ivec2 p[kEdgeBatch] = {}, q[kEdgeBatch] = {}, r[kEdgeBatch] = {};
  // In: what TileSlot keeps of each, and the object's turn: -1 where mirroring turns its faces inside out.
  alignas(64) std::uint32_t primitive[kEdgeBatch] = {}, planeClass[kEdgeBatch] = {}, object[kEdgeBatch] = {};
  alignas(64) std::int32_t turn[kEdgeBatch] = {};
  // Out: +1 front-facing (clockwise with y down), -1 back-facing, 0 where no sample of the tile can be covered. Then the rest is undefined.
  alignas(64) std::int32_t side[kEdgeBatch];
  // Out: samples that the bounds leave within the tile, inclusive, from its upper left one.
  alignas(64) std::int32_t x0[kEdgeBatch], y0[kEdgeBatch], x1[kEdgeBatch], y1[kEdgeBatch];
  // Out: about how many samples of the tile it covers.
  alignas(64) std::int32_t samples[kEdgeBatch];
  // Out: the slot of each and its setup, but for the slot's place, and the edges' place: kHasEdges alone.
  alignas(64) TileSlot slots[kEdgeBatch];
  alignas(64) TriangleSetup setups[kEdgeBatch];
  // Out: 1 for each that is set up, for those of them that are small, else 0; a bit for those that are not.
  alignas(64) std::uint32_t isKept[kEdgeBatch], isSmall[kEdgeBatch];
  std::uint32_t withEdges = 0;
  // Out: edge i is a·x + b·y + c >= 0 on the inner side (TriangleSetup); all zero for an edge that holds all of the bounds on its inner side.
  alignas(64) std::int32_t a[3][kEdgeBatch], b[3][kEdgeBatch], c[3][kEdgeBatch];
  DepthExtent extent;   // In, out: grows by what these triangles reach.
};

struct TileFrame {
  int x0, y0, width, height;   // pixels
  int bits;                    // sub-pixel bits of the grid
  const DepthPlane* planes;    // by plane class
  double u = 0, v = 0;         // of the first sample, in the planes' coordinates
};

// Sets up the first `count` triangles of a batch.
void setUpEdges(EdgeBatch& batch, int count, const TileFrame& tile);

}  // namespace copeel::cpu
