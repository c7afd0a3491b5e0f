#include "apps/bench/subject.h"

#include <algorithm>
#include <chrono>

#include "core/image/write_image.h"

namespace copeel::bench {
namespace {

constexpr double kQuickMs = 2000;   // a first frame that took less is drawn again: it compiled shaders and grew buffers

oit::RenderOptions renderOptions(const MeasureOptions& options, bool hardwareDepth, bool compares) {
  oit::RenderOptions render;
  render.threads = options.threads;
  render.methodOptions.hardwareDepth = hardwareDepth;
  render.wantFloats = render.wantDepth = compares;
  return render;
}

// What the frame says of itself, less the counts, which are made apart.
void takeCosts(Stats& stats, const Stats& frame) {
  const Stats counts = stats;
  stats = frame;
  stats.fragments = counts.fragments;
  stats.fragmentsCaptured = counts.fragmentsCaptured;
  stats.capturedMax = counts.capturedMax;
  stats.depthComplexityMax = counts.depthComplexityMax;
  stats.coveredPixels = counts.coveredPixels;
  stats.coplanarPixels = counts.coplanarPixels;
}

}  // namespace

Subject::Subject(const BenchScene& scene, int width, int height, const MeasureOptions& options, bool hardwareDepth, bool compares)
    : options_(options), compares_(compares), renderer_(scene.parts, renderOptions(options, hardwareDepth, compares)), view_(viewOf(scene, renderer_.bounds(), width, height)) {
  if (!compares) return;
  shape_ = shapeOf(scene.parts, view_, options.threads);
  oit::RenderOptions exact = renderOptions(options, false, true);
  exact.decideAllExactly = true;
  oit::Renderer tile(scene.parts, exact);
  reference_ = tile.draw(view_);
  truth_ = tile.stats();
  onEdge_ = edgePixels(scene.parts, view_);
}

double Subject::draw(oit::Frame& frame) {
  const auto start = std::chrono::steady_clock::now();
  frame = renderer_.draw(view_);
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

double Subject::warm(const MethodRun& run, Entry& entry) {
  renderer_.setMethod(*run.method, run.options);
  oit::Frame frame;
  double ms = draw(frame);
  if (ms < kQuickMs) ms = std::min(ms, draw(frame));
  entry.stats = renderer_.stats();
  if (!compares_) return ms;
  entry.error = compare(frame, reference_, onEdge_);
  count(run, entry);
  if (!options_.pictureFolder.empty()) writePictures(entry, frame);
  return ms;
}

void Subject::count(const MethodRun& run, Entry& entry) {
  if (run.method->backend == "gl") {
    renderer_.measure();
    Stats counted = renderer_.stats();
    takeCosts(counted, entry.stats);
    entry.stats = counted;
    return;
  }
  if (run.method->keeps == Keeps::KNearest) return;
  // The plain z-buffer counts nothing of itself: it keeps one fragment of each pixel.
  const bool all = run.method->robust;
  entry.stats.fragments = truth_.fragments;
  entry.stats.fragmentsCaptured = all ? truth_.fragments : truth_.coveredPixels;
  entry.stats.depthComplexityMax = truth_.depthComplexityMax;
  entry.stats.capturedMax = all ? truth_.depthComplexityMax : 1;
  entry.stats.coveredPixels = truth_.coveredPixels;
  entry.stats.coplanarPixels = truth_.coplanarPixels;
}

void Subject::writePictures(Entry& entry, const oit::Frame& frame) const {
  const std::string stem = fileNameOf(entry.scene + "-" + entry.method);
  entry.picture = stem + ".png";
  entry.errorMap = stem + "-error.png";
  writePng(options_.pictureFolder + "/" + entry.picture, frame.color);
  writePng(options_.pictureFolder + "/" + entry.errorMap, errorMap(frame, reference_, onEdge_));
}

double Subject::time(const MethodRun& run, Entry& entry) {
  renderer_.setMethod(*run.method, run.options);
  oit::Frame frame;
  const double ms = draw(frame);
  takeCosts(entry.stats, renderer_.stats());
  return ms;
}

}  // namespace copeel::bench
