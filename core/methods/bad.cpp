// Adaptive bucket peeling: as bun, with buckets that follow the fragments. A pixel's own depth range is measured, then which of its 256 intervals
// are occupied; those are dealt out to the K buckets evenly.
// Based on: Liu, Huang, Liu, Wu. Efficient Depth Peeling via Bucket Sort. High Performance Graphics 2009, section on adaptive bucket depth peeling.
// Changed: see bun.cpp; intervals rather than their fragments are dealt out, as one bit is kept of each.
// Passes: 4. Bytes per pixel: 16 K + 40 (the paper: 6K + 3 words).
// Loses: as bun, but layers that lie close together only where they share an interval, or where there are more than K intervals.
#include <fmt/format.h>

#include "core/gl/layout.h"
#include "core/methods/buckets.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

constexpr std::uint32_t kWords = 8;   // of the map, 32 intervals each

}  // namespace

MethodCounts drawBad(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "core/methods/bad.glsl";
  const gl::Defines defines = {{"K", fmt::format("{}", options.k)}, {"BAD_WORDS", fmt::format("{}", kWords)}};
  frame.pixelWords("range near", 4).clear(COPEEL_KEY_NONE);
  frame.pixelWords("range far", 5).clear(0);
  frame.pixelWords("range map", 6, kWords).clear(0);
  frame.drawGeometry(frame.geometryProgram(file, "RANGE", defines));
  frame.drawGeometry(frame.geometryProgram(file, "OCCUPY", defines));
  drawBucketPairs(frame, file, options.k, defines);
  return {.iterations = 1};
}

}  // namespace copeel
