// From parts to a frame: one pass over the tiles a sample; what is of the pixel's centre has a pass of its own where samples are averaged.
#include "apps/oit/render_oit.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#if COPEEL_GL
#include "apps/oit/gl_pass.h"
#endif
#include "apps/oit/over_fold.h"
#include "core/cpu/render_nearest.h"
#include "core/cpu/render_tiles.h"
#include "core/error.h"
#include "core/image/filled.h"
#include "core/parallel.h"
#include "core/scene/sample_offset.h"

namespace copeel::oit {

struct Renderer::State {
  RenderOptions options;
  Scene scene;
  PlaneClasses planes;
  fold::OverTables tables;
  std::vector<std::uint8_t> opaque;     // per part: some face is
  std::vector<std::uint8_t> allOpaque;  // per part: every face is
  std::unique_ptr<Threads> threads;
#if COPEEL_GL
  std::unique_ptr<GlPass> glPass;       // once a method of the gl back end draws
#endif
  Stats stats;

  void prepare(const std::vector<Part>& parts);
  void drawPass(const View& view, const Targets& targets);
  void drawSamples(const View& view, Frame& frame);
  glm::vec3 background() const { return glm::vec3(options.background[0], options.background[1], options.background[2]); }
};

void Renderer::State::prepare(const std::vector<Part>& parts) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<Object> objects;
  for (const Part& part : parts) {
    objects.push_back({part.mesh, part.worldFromObject});
    if (part.faceColors.empty()) tables.addObject(part.color);
    else tables.addObject(part.faceColors);
    const auto isOpaque = [](const glm::vec4& color) { return color.a >= 1; };
    opaque.push_back(part.faceColors.empty() ? isOpaque(part.color) : std::any_of(part.faceColors.begin(), part.faceColors.end(), isOpaque));
    allOpaque.push_back(opaque.back() && std::all_of(part.faceColors.begin(), part.faceColors.end(), isOpaque));
  }
  scene = Scene(std::move(objects));
  planes = PlaneClasses(scene, options.coplanarTolerance);
  stats.method = options.method->name;
  stats.backend = options.method->backend;
  stats.triangles = scene.primitiveCount();
  stats.leaves = parts.size();
  stats.planeClasses = planes.classes().size();
  stats.prepareMs = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

void Renderer::State::drawPass(const View& view, const Targets& targets) {
  tables.shades = fold::shadesOf(planes, view, options.lit, options.lights);
#if COPEEL_GL
  if (options.method->draw) {
    if (!glPass) glPass = std::make_unique<GlPass>(scene, planes, allOpaque, options.methodOptions);
    return glPass->draw(view, tables, background(), !targets.counts(), *options.method, targets, stats);
  }
#endif
  ++stats.passes;
  const cpu::Frame frame(scene, planes, view);
  const Canvas canvas(frame, targets);
  const auto makeFold = [&] { return OverFold(frame, tables, opaque, background(), canvas); };
  if (options.method->keeps == Keeps::Nearest) {
    cpu::renderNearestTiles(frame, [&] {
      return [fold = makeFold()](cpu::Tile& tile, std::uint64_t* keys) mutable { fold.takeNearest(tile, keys); };
    });
    return;
  }
  cpu::TileOptions tileOptions;
  tileOptions.decideAllExactly = options.decideAllExactly;
  if (options.method->keeps == Keeps::KNearest) tileOptions.nearest = options.methodOptions.k;
  const cpu::TileCounts counts = cpu::renderTiles(frame, tileOptions, makeFold);
  stats.fragments = counts.fragments;
  stats.fragmentsCaptured = counts.captured;
  stats.overflow = counts.fragments - counts.captured;
  stats.depthComplexityMax = counts.depthComplexityMax;
  stats.capturedMax = std::min<std::uint64_t>(counts.depthComplexityMax, tileOptions.nearest);
  stats.coveredPixels = counts.coveredPixels;
  stats.coplanarPixels = counts.walk.coplanarPixels;
  stats.decidedExactly = counts.walk.decidedExactly;
}

// The mean of the samples, rounded once.
void Renderer::State::drawSamples(const View& view, Frame& frame) {
  Image<glm::vec3> sum(view.width, view.height, glm::vec3(0)), sample;
  Targets targets;
  targets.floats = &sample;
  const auto forEachPixel = [&](auto visit) {
    parallelFor(sum.pixels.size(), 1 << 14, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) visit(i);
    });
  };
  for (int i = 0; i < options.samples; ++i) {
    View shifted = view;
    shifted.offset = sampleOffset(i, options.samples);
    sample = filled(view.width, view.height, background());
    drawPass(shifted, targets);
    forEachPixel([&](std::size_t p) { sum.pixels[p] += sample.pixels[p]; });
  }
  forEachPixel([&](std::size_t p) {
    sum.pixels[p] /= static_cast<float>(options.samples);
    frame.color.pixels[p] = rgb8Of(fold::overLevels(glm::dvec3(sum.pixels[p])));
  });
  if (options.wantFloats) frame.floats = std::move(sum);
}

Renderer::Renderer(std::vector<Part> parts, const RenderOptions& options) : state_(std::make_unique<State>()) {
  state_->options = options;
  state_->threads = std::make_unique<Threads>(options.threads);
  state_->threads->execute([&] { state_->prepare(parts); });
}

Renderer::~Renderer() = default;

void Renderer::setMethod(const MethodInfo& method, const MethodOptions& options) {
  state_->options.method = &method;
  state_->options.methodOptions = options;
  state_->stats.method = method.name;
  state_->stats.backend = method.backend;
  state_->stats.overflow = state_->stats.methodBytes = 0;
#if COPEEL_GL
  if (state_->glPass) state_->glPass->setOptions(options);
#endif
}

const Box& Renderer::bounds() const { return state_->scene.bounds(); }
const Stats& Renderer::stats() const { return state_->stats; }

void Renderer::measure() {
#if COPEEL_GL
  if (state_->glPass) state_->glPass->measure(*state_->options.method, state_->stats);
#endif
}

Frame Renderer::draw(const View& view) {
  State& state = *state_;
  const RenderOptions& options = state.options;
  Frame frame;
  Targets targets;   // of the pixel's centre
  state.stats.passes = 0;
  state.threads->execute([&] {
    const auto want = [&](bool wanted, auto& image, auto*& target, const auto& empty) {
      if (!wanted) return;
      image = filled(view.width, view.height, empty);
      target = &image;
    };
    const bool once = options.samples <= 1;
    frame.color = filled(view.width, view.height, toRgb8(state.background()));
    want(options.wantDepth, frame.depth, targets.depth, std::numeric_limits<float>::infinity());
    want(options.wantIds, frame.ids, targets.ids, std::uint16_t{0});
    want(options.wantLayers, frame.layers, targets.layers, std::uint16_t{0});
    want(options.wantCoplanar, frame.coplanar, targets.coplanar, std::uint16_t{0});
    want(once && options.wantFloats, frame.floats, targets.floats, state.background());
    if (once) targets.color = &frame.color;
    // The centre's pass comes last: the counts of the statistics are its own.
    if (!once) state.drawSamples(view, frame);
    if (once || targets.any()) state.drawPass(view, targets);
  });
  state.stats.width = view.width;
  state.stats.height = view.height;
  state.stats.memoryBytes = peakMemoryBytes();
  return frame;
}

}  // namespace copeel::oit
