// Triangles of a tile on their way from corners to edge functions, in batches, vectorised across triangles with run-time dispatch.
//
// Everything is exact: corners differ by less than 2^24 grid steps, so products stay below 2^48 and sums below 2^51, which a double holds to
// the last unit, as it does their division by a power of two. Every target therefore gives the same integers. Edges are Pineda's. A parallel
// algorithm for polygon rasterization. SIGGRAPH 1988.
#pragma once

#include <cstdint>

namespace copeel::cpu {

inline constexpr int kEdgeBatch = 32;   // triangles; a multiple of every target's lanes

struct EdgeBatch {
  // In: corners, grid coordinates.
  alignas(64) std::int32_t px[kEdgeBatch] = {}, py[kEdgeBatch] = {}, qx[kEdgeBatch] = {}, qy[kEdgeBatch] = {}, rx[kEdgeBatch] = {}, ry[kEdgeBatch] = {};
  // Out: +1 front-facing (clockwise with y down), -1 back-facing, 0 where no sample of the tile can be covered. Then the rest is undefined.
  alignas(64) std::int32_t side[kEdgeBatch];
  // Out: samples that the bounds leave within the tile, inclusive, from its upper left one.
  alignas(64) std::int32_t x0[kEdgeBatch], y0[kEdgeBatch], x1[kEdgeBatch], y1[kEdgeBatch];
  // Out: about how many samples of the tile it covers.
  alignas(64) std::int32_t samples[kEdgeBatch];
  // Out: where the bounds hold 4×4 samples at most: bit x + 8·y is set where sample (x0 + x, y0 + y) is covered. 0: larger bounds.
  alignas(64) std::int32_t covered[kEdgeBatch];
  // Out: edge i is a·x + b·y + c >= 0 on the inner side (TriangleSetup); all zero for an edge that holds all of the bounds on its inner side.
  alignas(64) std::int32_t a[3][kEdgeBatch], b[3][kEdgeBatch], c[3][kEdgeBatch];
};

struct TileFrame {
  int x0, y0, width, height;   // pixels
  int bits;                    // sub-pixel bits of the grid
};

// Sets up the first `count` triangles of a batch.
void setUpEdges(EdgeBatch& batch, int count, const TileFrame& tile);

}  // namespace copeel::cpu
