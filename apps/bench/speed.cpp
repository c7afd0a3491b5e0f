#include "apps/bench/speed.h"

#include <fmt/format.h>

#include "apps/bench/deadline.h"
#include "apps/bench/limits.h"

namespace copeel::bench {
namespace {

constexpr int kWidth = 1280, kHeight = 720, kThreads = 2;
// Frames, those of the cpu's two methods together, have about as much time as a peer's: the least of a tenth of a second tells what else the machine did
// then.
constexpr int kFrames = 10000;
constexpr double kTwoMethodsMs = 1.6 * kEnoughMs;
constexpr std::uint32_t kBufferLength = 8;
// Shares of what time is left: three scenes on the gl back end, and VTK beside two of them.
constexpr double kSceneShare = 0.25, kPeerShare = 0.5;

// The cpu's methods have their turns apart from the gl back end's: what takes seconds between two frames of milliseconds cools caches.
std::vector<Entry> measureOne(const BenchScene& scene, const SpeedOptions& options, double budgetMs) {
  MeasureOptions measure;
  measure.threads = kThreads;
  measure.frames = kFrames;
  measure.budgetMs = kTwoMethodsMs;
  measure.methods = runsThatAre({"tile", "zbuffer"}, options.backend == "gl" ? "none" : "cpu", kBufferLength);
  std::vector<Entry> entries = timeScene(scene, kWidth, kHeight, measure);
  measure.budgetMs = budgetMs;
  measure.methods = runsThatAre({"auto", "fab", "ll", "sb", "bun-ll", kPlainList}, options.backend == "cpu" ? "none" : "gl", kBufferLength);
  for (Entry& entry : timeScene(scene, kWidth, kHeight, measure)) entries.push_back(std::move(entry));
  return entries;
}

void measurePeer(SpeedScene& result, const BenchScene& scene, const SpeedOptions& options, std::string& note) {
  const VtkJob job{scene.parts.front().mesh.get(), scene.parts.size(), kWidth, kHeight, options.frames, kThreads};
  if (const auto entry = runVtk(job, note)) result.vtkMs = entry->minMs;
}

}  // namespace

SpeedRun measureSpeed(const StandIns& standIns, const SpeedOptions& options) {
  const Deadline deadline(options.budgetMs);
  SpeedRun run;
  double peerMs = 0;   // of VTK's first run
  double frameMs = 0;  // and of its frames
  for (const std::size_t copyCount : {1u, 12u, 0u}) {
    const bool isHairball = copyCount == 0;
    const BenchScene scene = isHairball ? standIns.hairball() : standIns.bunny(copyCount);
    SpeedScene result{scene.name, scene.title, isHairball ? 0 : mostMsOf(copyCount), mostRatioOf(isHairball), {}, 0};
    result.entries = measureOne(scene, options, kSceneShare * deadline.leftMs());
    // Frames of VTK take as many times longer as there are copies, at least.
    const double expectedMs = peerMs + double(copyCount * static_cast<std::size_t>(options.frames + 1)) * frameMs;
    if (options.withPeer && !isHairball && expectedMs < kPeerShare * deadline.leftMs()) {
      const double before = deadline.leftMs();
      measurePeer(result, scene, options, run.peerNote);
      peerMs = before - deadline.leftMs(), frameMs = result.vtkMs;
    } else if (options.withPeer && !isHairball) {
      run.peerNote += fmt::format(" Left out with {} copies: it would take {:.0f} s.", copyCount, expectedMs / 1e3);
    }
    run.scenes.push_back(std::move(result));
  }
  if (!options.withPeer) run.peerNote = "VTK: not run.";
  return run;
}

std::string toText(const SpeedRun& run) {
  std::string text = fmt::format("Speed at {} x {}, {} threads, ms a frame (least)\n", kWidth, kHeight, kThreads);
  for (const SpeedScene& scene : run.scenes) {
    text += fmt::format("{}: {}\n", scene.name, scene.title);
    for (const Entry& e : scene.entries) text += e.measured() ? fmt::format("  {:<12} {:>9.2f}\n", e.method, e.minMs) : fmt::format("  {:<12} {}{}\n", e.method, e.failure, e.leftOut);
    if (scene.vtkMs > 0) text += fmt::format("  {:<12} {:>9.2f}\n", "VTK", scene.vtkMs);
  }
  return text + run.peerNote + "\n";
}

}  // namespace copeel::bench
