// Uniform bucket peeling: the scene's depth range is cut into K uniform buckets, each of which keeps its nearest and its farthest fragment of a pixel.
// Based on: Liu, Huang, Liu, Wu. Efficient Depth Peeling via Bucket Sort. High Performance Graphics 2009.
// Changed: the paper blends depths alone (or packs attributes behind them); an id needs a pass of its own, as there are no 64-bit atomics to rely on.
// One peel, no further ones of what lies between: they would come out of order. Of coplanar fragments the later primitive stays.
// Passes: 2. Bytes per pixel: 16 K (the paper: 4K + 2 words).
// Loses: what lies between the two of a bucket, and all but one fragment of a group: R_h = Σ min(2, D of the bucket) / N ≤ D / N.
#include <fmt/format.h>

#include "core/methods/buckets.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawBun(gl::Frame& frame, const MethodOptions& options) {
  drawBucketPairs(frame, "core/methods/bun.glsl", options.k, {{"K", fmt::format("{}", options.k)}});
  return {.iterations = 1};
}

}  // namespace copeel
