// From model to frame: leaves become a scene, sections become leaves, the fold's surfaces become pixels.
#include "apps/csg/render_csg.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "apps/csg/bounds.h"
#if COPEEL_GL
#include "apps/csg/gl_pass.h"
#endif
#include "apps/csg/look.h"
#include "core/cpu/render_nearest.h"
#include "core/cpu/render_tiles.h"
#include "core/formats/read_mesh.h"
#include "core/image/filled.h"
#include "core/parallel.h"
#include "core/scene/sample_offset.h"

namespace copeel::csg {
namespace {

double nowMs() {
  using namespace std::chrono;
  return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

double alphaOfLook(const void* look, std::uint32_t leaf, std::uint32_t part) { return static_cast<const Look*>(look)->alpha(leaf, part); }

// A box that reaches from the section plane well past the model; without triangles where that is beside all of it.
std::shared_ptr<const Mesh> sectionMesh(const Section& section, const Box& bounds) {
  auto mesh = std::make_shared<Mesh>();
  if (bounds.empty()) return mesh;
  Box box = bounds;
  const glm::dvec3 margin(bounds.diagonal() + 1);
  box.min -= margin;
  box.max += margin;
  const double at = std::clamp(section.at, box.min[section.axis], box.max[section.axis]);
  if (at == (section.below ? box.min : box.max)[section.axis]) return mesh;
  (section.below ? box.max : box.min)[section.axis] = at;
  for (int corner = 0; corner < 8; ++corner) {
    mesh->vertices.emplace_back(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z);
  }
  constexpr std::uint32_t kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (std::uint32_t f = 0; f < 6; ++f) {
    mesh->triangles.insert(mesh->triangles.end(), {{kFaces[f][0], kFaces[f][1], kFaces[f][2]}, {kFaces[f][0], kFaces[f][2], kFaces[f][3]}});
    mesh->facets.insert(mesh->facets.end(), {f, f});
  }
  return mesh;
}

}  // namespace

struct Renderer::State {
  const Model& model;
  RenderOptions options;
  Box bounds;
  std::vector<std::uint32_t> sectionLeaves;
  Scene scene;
  PlaneClasses planes;
  GateForest forest;
  std::unique_ptr<Look> look;
  std::unordered_map<const Mesh*, bool> closedMeshes;   // found out only where the eye may be inside
  std::unique_ptr<Threads> threads;
#if COPEEL_GL
  std::unique_ptr<GlPass> glPass;                       // once a method of the gl back end draws
#endif
  Stats stats;

  State(const Model& m, const RenderOptions& o) : model(m), options(o) {}
  void prepare();
  std::vector<std::uint8_t> knownClosed;                // per object, found out for small meshes
  void findSmallClosedMeshes();
  std::vector<std::uint8_t> closedObjects(const std::vector<std::uint8_t>& reachesEye);
  EyeWinding windingAtEye(const View& view, const std::vector<std::uint8_t>& reachesEye);
  void drawPass(const View& view, PixelSink& sink);
  void drawSamples(const View& view, Image<Rgb8>& color);
  void drawTiles(const cpu::Frame& frame, PixelSink& sink);
};

void Renderer::State::prepare() {
  const double start = nowMs();
  std::vector<Object> objects;
  for (const Leaf& leaf : model.leaves) objects.push_back({leaf.mesh, leaf.worldFromObject});
  bounds = viewBounds(model);
  scene = Scene(objects);
  if (!options.sections.empty()) {
    for (const Section& section : options.sections) {
      sectionLeaves.push_back(static_cast<std::uint32_t>(objects.size()));
      objects.push_back({sectionMesh(section, scene.bounds()), glm::dmat4(1)});
    }
    scene = Scene(std::move(objects));
  }
  planes = PlaneClasses(scene, options.coplanarTolerance);
  std::vector<std::uint8_t> translucent(scene.objects().size(), 0);
  for (std::size_t i = 0; i < model.leaves.size(); ++i) translucent[i] = model.leaves[i].color && model.leaves[i].color->a < 1;
  forest = buildGates(model, sectionLeaves, translucent, static_cast<std::uint32_t>(scene.objects().size()));
  look = std::make_unique<Look>(model, forest, options);
  findSmallClosedMeshes();
  stats.method = options.method->name;
  stats.backend = options.method->backend;
  stats.triangles = scene.primitiveCount();
  stats.leaves = model.leaves.size();
  stats.planeClasses = planes.classes().size();
  stats.prepareMs = nowMs() - start;
}

// Knowing that a leaf is closed helps to drop it where it does not matter; it is worth a look at a few thousand triangles, not at millions.
void Renderer::State::findSmallClosedMeshes() {
  constexpr std::size_t kTriangles = 20000;
  std::size_t looked = 0;
  knownClosed.assign(scene.objects().size(), 0);
  for (std::size_t i = 0; i < knownClosed.size(); ++i) {
    const Mesh* mesh = scene.objects()[i].mesh.get();
    auto known = closedMeshes.find(mesh);
    if (known == closedMeshes.end() && looked + mesh->triangles.size() <= kTriangles) {
      looked += mesh->triangles.size();
      known = closedMeshes.emplace(mesh, statusOf(*mesh).closed).first;
    }
    knownClosed[i] = known != closedMeshes.end() && known->second;
  }
}

std::vector<std::uint8_t> Renderer::State::closedObjects(const std::vector<std::uint8_t>& reachesEye) {
  std::vector<std::uint8_t> closed(scene.objects().size(), 0);
  for (std::size_t i = 0; i < closed.size(); ++i) {
    if (!reachesEye[i]) continue;
    const Mesh* mesh = scene.objects()[i].mesh.get();
    auto [entry, fresh] = closedMeshes.try_emplace(mesh, false);
    if (fresh) entry->second = statusOf(*mesh).closed;
    closed[i] = entry->second;
  }
  return closed;
}

EyeWinding Renderer::State::windingAtEye(const View& view, const std::vector<std::uint8_t>& reaches) {
  if (std::find(reaches.begin(), reaches.end(), 1) == reaches.end()) return {};
  return eyeWinding(scene, view.eye, reaches, closedObjects(reaches));
}

void Renderer::State::drawTiles(const cpu::Frame& frame, PixelSink& sink) {
  const EyeWinding eye = windingAtEye(frame.view, frame.projection.reachesEye);
  cpu::TileOptions tileOptions;
  tileOptions.decideAllExactly = options.decideAllExactly;
  if (options.method->keeps == Keeps::KNearest) tileOptions.nearest = options.methodOptions.k;
  const cpu::TileCounts counts = cpu::renderTiles(
      frame, tileOptions, [&] { return CsgFold(forest, eye, knownClosed, options.inside, alphaOfLook, look.get(), sink); });
  stats.fragments = counts.fragments;
  stats.fragmentsCaptured = counts.captured;
  stats.overflow = counts.fragments - counts.captured;
  stats.depthComplexityMax = counts.depthComplexityMax;
  stats.capturedMax = std::min<std::uint64_t>(counts.depthComplexityMax, tileOptions.nearest);
  stats.coveredPixels = counts.coveredPixels;
  stats.coplanarPixels = counts.walk.coplanarPixels;
  stats.decidedExactly = counts.walk.decidedExactly;
}

void Renderer::State::drawPass(const View& view, PixelSink& sink) {
  look->setView(planes, view);
#if COPEEL_GL
  if (options.method->draw) {
    if (!glPass) glPass = std::make_unique<GlPass>(scene, planes, forest, static_cast<std::uint32_t>(model.background.size()), options.inside, options.methodOptions);
    const EyeWinding eye = windingAtEye(view, cpu::project(scene, view).reachesEye);
    return glPass->draw(view, eye, alphaOfLook, look.get(), *options.method, sink, stats);
  }
#endif
  ++stats.passes;
  const cpu::Frame frame(scene, planes, view);
  if (options.method->keeps == Keeps::Nearest) {
    cpu::renderNearest(frame, [&](int x, int y, const cpu::TileSlot& slot, const cpu::Tile& tile) {
      const Surface surface{slot.primitive, slot.planeClass, tile.objects[slot.object].object, 0};
      sink.pixels({x, y, 1, 1}, {&surface, 1}, sink.color({&surface, 1}));
    });
  } else {
    drawTiles(frame, sink);
  }
}

namespace {

// What a pixel shows of the solid: two pixels on one face show the same.
struct Shown {
  std::uint32_t leaf = ~std::uint32_t{0}, planeClass = ~std::uint32_t{0};
  friend bool operator==(const Shown&, const Shown&) = default;
};

// openscad's edges are black lines of one pixel: here, where a pixel shows another face than the one right of it or below.
void drawEdges(const Image<Shown>& shown, Image<Rgb8>& color) {
  for (int y = 0; y < color.height; ++y) {
    for (int x = 0; x < color.width; ++x) {
      const bool right = x + 1 < color.width && shown.at(x, y) != shown.at(x + 1, y);
      const bool below = y + 1 < color.height && shown.at(x, y) != shown.at(x, y + 1);
      if (right || below) color.at(x, y) = Rgb8{};
    }
  }
}

// Writes surfaces into the frame's images; colours are summed over samples.
class FrameSink : public PixelSink {
 public:
  FrameSink(Frame& frame, const Look& look, Image<glm::vec3>* sum, Image<Shown>* shown)
      : frame_(frame), look_(look), sum_(sum), shown_(shown) {}
  // Depth needs the view's planes.
  void setView(const Scene& scene, const PlaneClasses& planes, const View& view) {
    view_ = &view;
    if (!frame_.depth.pixels.empty()) depths_ = depthPlanes(scene, planes, view);
  }
  PixelColor color(std::span<const Surface> surfaces) const override {
    const glm::dvec3 color = look_.blend(surfaces);
    return sum_ ? PixelColor{{}, glm::vec3(color - look_.blend({}))} : PixelColor{toRgb8(color), {}};
  }
  void pixels(const PixelRect& rect, std::span<const Surface> surfaces, const PixelColor& color) override {
    if (sum_) forEachOf(rect, [&](int x, int y) { sum_->at(x, y) += color.added; });
    else if (!frame_.color.pixels.empty()) frame_.color.fill(rect, color.levels);
    if (frame_.depth.pixels.empty() && frame_.ids.pixels.empty() && !shown_) return;
    const auto solid = std::find_if(surfaces.begin(), surfaces.end(), [](const Surface& s) { return s.part == 0; });
    if (solid == surfaces.end()) return;
    if (shown_) shown_->fill(rect, {solid->leaf, solid->planeClass});
    if (!frame_.ids.pixels.empty()) frame_.ids.fill(rect, static_cast<std::uint16_t>(std::min<std::uint32_t>(solid->leaf + 1, 65535)));
    if (frame_.depth.pixels.empty()) return;
    forEachOf(rect, [&](int x, int y) { frame_.depth.at(x, y) = static_cast<float>(distanceAt(depths_[solid->planeClass], *view_, x, y)); });
  }

 private:
  Frame& frame_;
  const Look& look_;
  Image<glm::vec3>* sum_;
  Image<Shown>* shown_;
  const View* view_ = nullptr;
  DepthPlanes depths_;
};

}  // namespace

// Colours are the mean of the samples, summed as differences from the background so that pixels nothing was drawn to need no visit.
void Renderer::State::drawSamples(const View& view, Image<Rgb8>& color) {
  Image<glm::vec3> sum(view.width, view.height, glm::vec3(0));
  for (int i = 0; i < options.samples; ++i) {
    View shifted = view;
    shifted.offset = sampleOffset(i, options.samples);
    Frame none;
    FrameSink sink(none, *look, &sum, nullptr);
    drawPass(shifted, sink);
  }
  const std::array<double, 3>& b = options.scheme.background;
  for (std::size_t i = 0; i < sum.pixels.size(); ++i) {
    color.pixels[i] = toRgb8(glm::dvec3(b[0], b[1], b[2]) + glm::dvec3(sum.pixels[i]) / double(options.samples));
  }
}

Renderer::Renderer(const Model& model, const RenderOptions& options) : state_(std::make_unique<State>(model, options)) {
  state_->threads = std::make_unique<Threads>(options.threads);
  state_->threads->execute([&] { state_->prepare(); });
}

Renderer::~Renderer() = default;

const Box& Renderer::bounds() const { return state_->bounds; }
const Stats& Renderer::stats() const { return state_->stats; }

void Renderer::setMethod(const MethodInfo& method, const MethodOptions& options) {
  state_->options.method = &method;
  state_->options.methodOptions = options;
  state_->stats.method = method.name;
  state_->stats.backend = method.backend;
  state_->stats.overflow = 0;
#if COPEEL_GL
  if (state_->glPass) state_->glPass->setOptions(options);
#endif
}

void Renderer::measure() {
#if COPEEL_GL
  if (state_->glPass) state_->glPass->measure(*state_->options.method, state_->stats);
#endif
}

Frame Renderer::draw(const View& view) {
  State& state = *state_;
  const RenderOptions& options = state.options;
  state.stats.passes = 0;
  Frame frame;
  const std::array<double, 3>& b = options.scheme.background;
  if (options.wantIds) frame.ids = Image<std::uint16_t>(view.width, view.height);
  Image<Shown> shown;
  if (options.edges) shown = Image<Shown>(view.width, view.height);
  state.threads->execute([&] {
    frame.color = filled(view.width, view.height, toRgb8({b[0], b[1], b[2]}));
    if (options.wantDepth) frame.depth = filled(view.width, view.height, std::numeric_limits<float>::infinity());
    // Depth, ids and edges are those of the pixel's centre.
    if (options.samples <= 1 || options.wantDepth || options.wantIds || options.edges) {
      FrameSink sink(frame, *state.look, nullptr, options.edges ? &shown : nullptr);
      sink.setView(state.scene, state.planes, view);
      state.drawPass(view, sink);
    }
    if (options.samples > 1) state.drawSamples(view, frame.color);
  });
  if (options.edges) drawEdges(shown, frame.color);
  state.stats.width = view.width;
  state.stats.height = view.height;
  state.stats.memoryBytes = peakMemoryBytes();
  return frame;
}

}  // namespace copeel::csg
