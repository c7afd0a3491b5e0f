#include "apps/bench/measure.h"

#include <algorithm>
#include <chrono>

#include <fmt/format.h>

#include "core/error.h"
#include "core/image/write_image.h"

namespace copeel::bench {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kEnoughMs = 1500;   // of one method in one scene: then its timed frames end

oit::RenderOptions renderOptions(const MeasureOptions& options) {
  oit::RenderOptions render;
  render.threads = options.threads;
  render.wantFloats = render.wantDepth = true;
  return render;
}

// The two renderers of a scene: one for all methods, which share what is on the device, and one for the reference.
class Subject {
 public:
  Subject(const BenchScene& scene, int width, int height, const MeasureOptions& options)
      : options_(options), scene_(scene), renderer_(scene.parts, renderOptions(options)) {
    oit::RenderOptions exact = renderOptions(options);
    exact.decideAllExactly = true;
    oit::Renderer tile(scene.parts, exact);
    view_ = viewOf(scene, tile.bounds(), width, height);
    reference_ = tile.draw(view_);
    truth_ = tile.stats();
    onEdge_ = edgePixels(scene.parts, view_);
  }

  void warm(const MethodRun& run, Entry& entry);   // the first frame: error, counts, pictures
  double time(const MethodRun& run);

 private:
  void writePictures(Entry& entry, const oit::Frame& frame) const;

  const MeasureOptions& options_;
  const BenchScene& scene_;
  oit::Renderer renderer_;
  View view_;
  oit::Frame reference_;
  Stats truth_;
  std::vector<std::uint8_t> onEdge_;
};

void Subject::warm(const MethodRun& run, Entry& entry) {
  renderer_.setMethod(*run.method, run.options);
  renderer_.draw(view_);   // compiles shaders, grows buffers
  const oit::Frame frame = renderer_.draw(view_);
  entry.error = compare(frame, reference_, onEdge_);
  entry.stats = renderer_.stats();
  if (entry.backend == "gl") {
    renderer_.measure();
    const Stats counted = renderer_.stats();
    entry.stats.fragments = counted.fragments;
    entry.stats.fragmentsCaptured = counted.fragmentsCaptured;
    entry.stats.capturedMax = counted.capturedMax;
    entry.stats.depthComplexityMax = counted.depthComplexityMax;
  } else if (run.method->keeps != Keeps::KNearest) {
    // The plain z-buffer counts nothing of itself: it keeps one fragment of each pixel.
    const bool all = entry.robust;
    entry.stats.fragments = truth_.fragments;
    entry.stats.fragmentsCaptured = all ? entry.stats.fragments : truth_.coveredPixels;
    entry.stats.depthComplexityMax = truth_.depthComplexityMax;
    entry.stats.capturedMax = all ? truth_.depthComplexityMax : 1;
  }
  if (!options_.pictureFolder.empty()) writePictures(entry, frame);
}

void Subject::writePictures(Entry& entry, const oit::Frame& frame) const {
  const std::string stem = fileNameOf(entry.scene + "-" + entry.method);
  entry.picture = stem + ".png";
  entry.errorMap = stem + "-error.png";
  writePng(options_.pictureFolder + "/" + entry.picture, frame.color);
  writePng(options_.pictureFolder + "/" + entry.errorMap, errorMap(frame, reference_, onEdge_));
}

double Subject::time(const MethodRun& run) {
  renderer_.setMethod(*run.method, run.options);
  const auto start = Clock::now();
  renderer_.draw(view_);
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

}  // namespace

std::vector<MethodRun> runsOf(std::string_view backend, std::string_view text, std::uint32_t k) {
  std::vector<MethodRun> runs;
  // What there is none of is refused; what one back end alone has, or takes these modifiers, runs there.
  MethodRun run{nullptr, {.k = k}, {}};
  const MethodInfo& first = chooseMethod(backend, text, run.options);
  for (const MethodInfo& method : methods()) {
    if (method.name != first.name || (backend != "auto" && backend != method.backend)) continue;
    if (&method != &first && text != method.name) continue;
    run.method = &method;
    const bool isShared = findMethod(method.name, "cpu") && findMethod(method.name, "gl");
    run.label = isShared ? fmt::format("{} ({})", text, method.backend) : text;
    runs.push_back(run);
  }
  return runs;
}

std::string fileNameOf(const std::string& method) {
  std::string name = method;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  }
  return name;
}

std::vector<Entry> measureScene(const BenchScene& scene, int width, int height, const MeasureOptions& options) {
  Subject subject(scene, width, height, options);
  std::vector<Entry> entries;
  for (const MethodRun& run : options.methods) {
    Entry entry;
    entry.scene = scene.name, entry.method = run.label, entry.backend = run.method->backend, entry.robust = run.method->robust;
    entry.width = width, entry.height = height;
    // A method that this machine cannot run (no GL, no memory) is a line of the report, not its end.
    try {
      subject.warm(run, entry);
    } catch (const Error& error) {
      if (error.code() != ExitCode::Machine) throw;
      entry.failure = error.what();
    }
    entries.push_back(std::move(entry));
  }
  std::vector<std::vector<double>> times(entries.size());
  std::vector<double> spent(entries.size());
  for (int frame = 0; frame < options.frames; ++frame) {
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (!entries[i].failure.empty() || spent[i] > kEnoughMs) continue;
      times[i].push_back(subject.time(options.methods[i]));
      spent[i] += times[i].back();
    }
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    std::vector<double>& ms = times[i];
    if (ms.empty()) continue;
    std::sort(ms.begin(), ms.end());
    entries[i].frames = static_cast<int>(ms.size());
    entries[i].minMs = ms.front();
    entries[i].medianMs = (ms[ms.size() / 2] + ms[(ms.size() - 1) / 2]) / 2;
  }
  return entries;
}

}  // namespace copeel::bench
