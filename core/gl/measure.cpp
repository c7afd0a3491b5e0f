#include "core/gl/measure.h"

#include <algorithm>

#include "core/methods/methods_gl.h"

namespace copeel::gl {
namespace {

constexpr std::uint32_t kCountWords = 4;   // core/fold/count.glsl: fragments, groups, largest group, uncertain orders

std::vector<std::uint32_t> countsOf(Renderer& renderer, DrawMethod method, const MethodOptions& options) {
  FoldSource count;
  count.defines = {{"FOLD", "core/fold/count.glsl"}, {"FOLD_COUNT_UNCERTAIN", "1"}};
  count.stateWords = 8;
  count.resultWords = kCountWords;
  renderer.setFold(count);
  renderer.draw(method, options);
  return renderer.result();
}

}  // namespace

void measure(Renderer& renderer, const MethodInfo& method, const MethodOptions& options, Stats& stats) {
  const std::vector<std::uint32_t> all = countsOf(renderer, drawLl, {.hardwareDepth = options.hardwareDepth});
  stats.fragments = stats.fragmentsCaptured = stats.capturedMax = stats.depthComplexityMax = stats.coveredPixels = stats.coplanarPixels = stats.uncertain = 0;
  for (std::size_t i = 0; i < all.size(); i += kCountWords) {
    stats.fragments += all[i];
    stats.depthComplexityMax = std::max<std::uint64_t>(stats.depthComplexityMax, all[i]);
    stats.coveredPixels += all[i] > 0;
    stats.coplanarPixels += all[i + 2] > 1;
    stats.uncertain += all[i + 3];
  }
  const std::vector<std::uint32_t> captured = countsOf(renderer, method.draw, options);
  for (std::size_t i = 0; i < captured.size(); i += kCountWords) {
    stats.fragmentsCaptured += captured[i];
    stats.capturedMax = std::max<std::uint64_t>(stats.capturedMax, captured[i]);
  }
}

}  // namespace copeel::gl
