// The tables to the device, a frame of the method, and its states to pixels by the same code as the cpu's.
#include "apps/oit/gl_pass.h"

#include <algorithm>
#include <bit>

#include "apps/oit/over_buffers.h"
#include "core/gl/measure.h"
#include "core/parallel.h"

namespace copeel::oit {
namespace {

double doubleOf(const std::uint32_t* words) { return std::bit_cast<double>(std::uint64_t{words[1]} << 32 | words[0]); }

// What a pixel's words say; the nearest primitive apart.
PixelResult resultOf(const std::uint32_t* words, const glm::vec3& background) {
  fold::OverState state;
  state.color = {doubleOf(words), doubleOf(words + 2), doubleOf(words + 4)};
  state.transmittance = doubleOf(words + 6);
  const glm::dvec3 color = fold::overResult(state, background);
  PixelResult result;
  result.color = glm::vec3(color);
  result.bytes = rgb8Of(fold::overLevels(color));
  result.layers = words[9];
  result.largestGroup = words[10];
  return result;
}

}  // namespace

struct GlPass::State {
  State(const Scene& s, const PlaneClasses& p, const std::vector<std::uint8_t>& a, const MethodOptions& o)
      : scene(s), planes(p), opaque(a), anyOpaque(std::find(a.begin(), a.end(), 1) != a.end()), options(o), renderer(s, p, o.hardwareDepth ? gl::DepthSource::Hardware : gl::DepthSource::Planes) {}

  const Scene& scene;
  const PlaneClasses& planes;
  std::vector<std::uint8_t> opaque;
  bool anyOpaque;
  MethodOptions options;
  gl::Renderer renderer;
  OverBuffers buffers;
};

GlPass::GlPass(const Scene& scene, const PlaneClasses& planes, const std::vector<std::uint8_t>& opaque, const MethodOptions& options)
    : state_(std::make_unique<State>(scene, planes, opaque, options)) {}

GlPass::~GlPass() { state_->renderer.context().tryMakeCurrent(); }   // its buffers are the context's

void GlPass::draw(const View& view, const fold::OverTables& tables, const glm::vec3& background, bool mayEnd, const MethodInfo& method,
                  const Targets& targets, Stats& stats) {
  State& state = *state_;
  state.renderer.setView(view);
  gl::FoldSource fold = state.buffers.upload(state.scene, tables, mayEnd);
  const bool hides = mayEnd && state.anyOpaque;
  if (hides) fold.defines.emplace_back("HIDE_BEHIND_OPAQUE", "1");
  state.renderer.setFold(fold);
  const gl::FrameCounts counts = state.renderer.draw(method.draw, state.options, [&](gl::Frame& frame) {
    if (hides) frame.hideBehind(state.opaque);
  });
  stats.passes += counts.passes;
  stats.overflow = counts.method.overflow;
  stats.iterations = counts.method.iterations;
  stats.methodBytes = counts.methodBytes;
  stats.objectsDrawn = counts.objectsDrawn;
  stats.passMs = counts.passMs;
  if (!counts.method.chosen.empty()) {
    stats.method = "auto: " + counts.method.chosen;
    stats.methodReason = counts.method.reason;
  }

  deliver(view, background, targets);
}

void GlPass::deliver(const View& view, const glm::vec3& background, const Targets& targets) const {
  const State& state = *state_;
  const DepthPlanes depths = targets.depth ? depthPlanes(state.scene, state.planes, view) : DepthPlanes();
  const auto put = [&](const std::uint32_t* pixel, int x, int y) {
    targets.put({x, y, 1, 1}, resultOf(pixel, background));
    if (pixel[8] == 0 || !(targets.depth || targets.ids)) return;
    const std::uint32_t object = state.scene.objectOf(pixel[8] - 1);
    const std::uint32_t facet = state.scene.objects()[object].mesh->facetOf(pixel[8] - 1 - state.scene.firstPrimitive(object));
    targets.putNearest(x, y, object, targets.depth ? distanceAt(depths[state.planes.classOf(object, facet)], view, x, y) : 0);
  };
  const auto width = static_cast<std::size_t>(view.width);
  state.renderer.visitResult([&](int firstRow, std::span<const std::uint32_t> words) {
    parallelFor(words.size() / kOverResultWords, 1 << 12, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        const std::uint32_t* const pixel = words.data() + i * kOverResultWords;
        if (pixel[9] != 0) put(pixel, static_cast<int>(i % width), firstRow + static_cast<int>(i / width));
      }
    });
  });
}

void GlPass::setOptions(const MethodOptions& options) { state_->options = options; }

void GlPass::measure(const MethodInfo& method, Stats& stats) { gl::measure(state_->renderer, method, state_->options, stats); }

}  // namespace copeel::oit
