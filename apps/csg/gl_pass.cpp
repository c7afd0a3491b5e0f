// The model as words for csg_fold.glsl, a frame of the method, and its results to the sink.
#include "apps/csg/gl_pass.h"

#include <algorithm>
#include <numeric>

#include "core/error.h"
#include "core/gl/measure.h"

namespace copeel::csg {
namespace {

constexpr std::uint32_t kFirstSurfaceLimit = 4;   // surfaces kept of a pixel; doubled until all fit

constexpr std::size_t kSurfaceWords = 3;          // primitive, part, leaf

std::uint32_t opacityOf(double alpha) { return alpha >= 1 ? 2 : alpha > 0 ? 1 : 0; }

// Words of a side's state: the constants of csg_fold.glsl.
std::size_t stateWords(std::size_t leaves, std::size_t gates, std::size_t surfaceLimit) { return 4 + kSurfaceWords * surfaceLimit + 5 * leaves + 3 * gates; }

}  // namespace

struct GlPass::State {
  State(const Scene& s, const PlaneClasses& planes, const GateForest& f, std::uint32_t b, InsideRule r, const MethodOptions& o)
      : scene(s), forest(f), backgroundCount(b), rule(r), options(o), renderer(s, planes, o.hardwareDepth ? gl::DepthSource::Hardware : gl::DepthSource::Planes) {
    std::vector<std::uint32_t> all(scene.objects().size());
    std::iota(all.begin(), all.end(), 0u);
    gates.prune(forest, all);
  }

  std::vector<std::uint32_t> modelWords(const EyeWinding& eye, CsgFold::Alpha alpha, const void* context) const;
  void setFold(const std::vector<std::uint32_t>& words, const EyeWinding& eye);
  gl::FrameCounts drawFrame(const EyeWinding& eye, const MethodInfo& method);
  bool deliver(const View& view, PixelSink& sink) const;   // false: a pixel has more surfaces than were kept

  const Scene& scene;
  const GateForest& forest;
  std::uint32_t backgroundCount;
  InsideRule rule;
  MethodOptions options;
  gl::Renderer renderer;
  PrunedForest gates;                       // all leaves live
  gl::Buffer model, fromStack, cut;         // cut: whether the driver ended a shader too early
  std::uint32_t surfaceLimit = kFirstSurfaceLimit;
};

GlPass::GlPass(const Scene& scene, const PlaneClasses& planes, const GateForest& forest, std::uint32_t backgroundCount, InsideRule rule,
               const MethodOptions& options)
    : state_(std::make_unique<State>(scene, planes, forest, backgroundCount, rule, options)) {}

GlPass::~GlPass() { state_->renderer.context().tryMakeCurrent(); }   // its buffers are the context's

std::vector<std::uint32_t> GlPass::State::modelWords(const EyeWinding& eye, CsgFold::Alpha alpha, const void* context) const {
  const auto leafCount = static_cast<std::uint32_t>(scene.objects().size());
  std::vector<std::uint32_t> leaves, uses, gateWords, outputs;
  for (std::uint32_t leaf = 0; leaf <= leafCount; ++leaf) {
    const bool last = leaf == leafCount;
    const auto opacity = [&](std::uint32_t part) { return last ? 0 : opacityOf(alpha(context, leaf, part)); };
    leaves.push_back(!last && eye.any ? static_cast<std::uint32_t>(eye.constant[leaf]) : 0);
    leaves.push_back(static_cast<std::uint32_t>(uses.size() / 2));
    leaves.push_back(opacity(0) | (leaf < forest.firstSection ? opacity(1) << 2 | opacity(backgroundCount + 1) << 4 : 0));
    if (last) break;
    for (const PrunedForest::Use& use : gates.uses(leaf)) uses.insert(uses.end(), {use.node, use.negated});
  }
  std::vector<std::uint32_t> topOfOutput(forest.outputs.size(), kNone);
  for (const PrunedForest::Node& node : gates.nodes()) {
    if (node.output != kNone) topOfOutput[node.output] = static_cast<std::uint32_t>(gateWords.size() / 3);
    gateWords.insert(gateWords.end(), {node.parent, node.negated, static_cast<std::uint32_t>(node.threshold - node.initial)});
  }
  for (std::size_t i = 0; i < forest.outputs.size(); ++i) {
    const std::uint32_t part = forest.outputs[i].part, kind = part == 0 ? 0 : part <= backgroundCount ? 1 : 2;
    outputs.insert(outputs.end(), {topOfOutput[i], part, kind | std::uint32_t{forest.outputs[i].opaqueShare} << 2});
  }
  const auto usesAt = static_cast<std::uint32_t>(leaves.size()), gatesAt = usesAt + static_cast<std::uint32_t>(uses.size());
  const auto outputsAt = gatesAt + static_cast<std::uint32_t>(gateWords.size());
  std::vector<std::uint32_t> words{leafCount, static_cast<std::uint32_t>(gateWords.size() / 3), static_cast<std::uint32_t>(forest.outputs.size()),
                                   surfaceLimit, static_cast<std::uint32_t>(rule), std::min(forest.firstSection, leafCount), usesAt, gatesAt, outputsAt};
  for (const auto* part : {&leaves, &uses, &gateWords, &outputs}) words.insert(words.end(), part->begin(), part->end());
  return words;
}

void GlPass::State::setFold(const std::vector<std::uint32_t>& words, const EyeWinding& eye) {
  model = gl::Buffer(words);
  std::vector<std::uint32_t> summed(scene.objects().size(), 0);
  if (eye.any) std::copy(eye.fromStack.begin(), eye.fromStack.end(), summed.begin());
  fromStack = gl::Buffer(summed);
  gl::FoldSource fold;
  fold.defines = {{"FOLD", "apps/csg/csg_fold.glsl"}};
  fold.stateWords = static_cast<std::uint32_t>(stateWords(scene.objects().size(), gates.nodes().size(), surfaceLimit));
  fold.resultWords = static_cast<std::uint32_t>(1 + kSurfaceWords * surfaceLimit);
  cut = gl::Buffer(std::vector<std::uint32_t>{0});
  fold.tables = {{&model}, {&fromStack}, {&cut}};
  fold.inMemory = true;
  renderer.setFold(fold);
}

gl::FrameCounts GlPass::State::drawFrame(const EyeWinding& eye, const MethodInfo& method) {
  const bool sums = eye.any && std::any_of(eye.fromStack.begin(), eye.fromStack.end(), [](auto s) { return s != 0; });
  return renderer.draw(method.draw, options, [&](gl::Frame& frame) {
    if (!sums) return;
    frame.drawGeometry(frame.geometryProgram("apps/csg/csg_crossings.glsl", "SUM"));
    frame.drawPixels(frame.pixelProgram("apps/csg/csg_crossings.glsl", "APPLY"));
  });
}

bool GlPass::State::deliver(const View& view, PixelSink& sink) const {
  const std::size_t pixelWords = 1 + kSurfaceWords * surfaceLimit, rowWords = pixelWords * static_cast<std::size_t>(view.width);
  std::vector<Surface> surfaces;
  const auto put = [&](const std::uint32_t* record, int x, int y) {
    surfaces.clear();
    for (std::uint32_t i = 0; i < record[0]; ++i) {
      const std::uint32_t* surface = record + 1 + kSurfaceWords * i;
      const std::uint32_t primitive = surface[0], object = scene.objectOf(primitive);
      const std::uint32_t facet = scene.objects()[object].mesh->facetOf(primitive - scene.firstPrimitive(object));
      surfaces.push_back({primitive, renderer.planes().classOf(object, facet), surface[2], surface[1]});
    }
    sink.pixels({x, y, 1, 1}, surfaces, sink.color(surfaces));
  };
  bool all = true;
  renderer.visitResult([&](int firstRow, std::span<const std::uint32_t> words) {
    for (std::size_t at = 0; at < words.size() && all; at += pixelWords) all = words[at] <= surfaceLimit;
    for (std::size_t at = 0; at < words.size() && all; at += pixelWords) {
      if (words[at] != 0) put(words.data() + at, static_cast<int>(at % rowWords / pixelWords), firstRow + static_cast<int>(at / rowWords));
    }
  });
  return all;
}

void GlPass::draw(const View& view, const EyeWinding& eye, CsgFold::Alpha alpha, const void* context, const MethodInfo& method,
                  PixelSink& sink, Stats& stats) {
  State& state = *state_;
  state.renderer.setView(view);
  for (;; state.surfaceLimit *= 2) {
    state.setFold(state.modelWords(eye, alpha, context), eye);
    const gl::FrameCounts counts = state.drawFrame(eye, method);
    if (state.cut.read<std::uint32_t>(1)[0] != 0) failMachine("gl: the driver ends shaders before a model of so many leaves is done; use --backend cpu");
    if (!state.deliver(view, sink)) continue;
    stats.passes += counts.passes;
    stats.overflow = counts.method.overflow;
    stats.methodBytes = counts.methodBytes;
    stats.objectsDrawn = counts.objectsDrawn;
    stats.passMs = counts.passMs;
    if (!counts.method.chosen.empty()) {
      stats.method = "auto: " + counts.method.chosen;
      stats.methodReason = counts.method.reason;
    }
    return;
  }
}

void GlPass::setOptions(const MethodOptions& options) { state_->options = options; }

void GlPass::measure(const MethodInfo& method, Stats& stats) { gl::measure(state_->renderer, method, state_->options, stats); }

}  // namespace copeel::csg
