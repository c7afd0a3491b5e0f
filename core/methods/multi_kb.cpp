// Multi-layer depth peeling via fragment sort: peels the K nearest depths at once into a buffer that nothing protects, and draws again until a pass
// changes nothing, which proves that no hazard has cost a layer.
// Based on: Liu, Wei, Xu, Wu. Multi-Layer Depth Peeling via Fragment Sort. Technical report 2006, CAD/Graphics 2009.
// Passes: 2 ⌈D/K⌉ + 1 where there are no hazards (each batch is drawn once more to see that; a last one finds nothing). `repeats` counts the others.
// Bytes per pixel: 8 K + 4 (the paper's table, as k-buffer: 2K + 2 words). K is at most 128.
// Opaque geometry comes first, as in the paper: for all methods alike, by the fold that says so (Frame::hideBehind).
// Loses: all but one fragment of each group (the depth equality test, without which repeats would store a fragment twice), R_h = D / N.
#include <algorithm>

#include <fmt/format.h>

#include "core/gl/frame.h"
#include "core/gl/layout.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

constexpr std::uint32_t kMostBuckets = 128;   // an array of as many lies in each invocation

}  // namespace

MethodCounts drawMultiKb(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "core/methods/multi_kb.glsl";
  const std::uint32_t k = std::min(options.k, kMostBuckets);
  const gl::Defines defines = {{"K", fmt::format("{}", k)}};
  const gl::Program& gather = frame.geometryProgram(file, "GATHER", defines);
  const gl::Program& resolve = frame.pixelProgram(file, "RESOLVE", defines);
  frame.pixelWords("peeled", 0).clear(0);
  frame.pixelWords("buckets", 1, 2 * std::size_t{k}).clear(COPEEL_KEY_NONE);
  frame.beginStates();
  MethodCounts counts;
  const auto changes = [&] { return frame.anySamplesOf([&] { frame.drawGeometry(gather); }); };
  while (changes()) {
    ++counts.iterations;
    while (changes()) ++counts.repeats;
    frame.drawPixels(resolve);
  }
  return counts;
}

}  // namespace copeel
