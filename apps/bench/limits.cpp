#include "apps/bench/limits.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "apps/bench/report.h"

namespace copeel::bench {
namespace {

constexpr double kMostBunnyMs = 4, kMostBunniesMs = 40;            // tile, 2 threads, 1280x720
constexpr double kMostRatio = 1.5, kMostHairballRatio = 2.2;       // tile to plain z-buffer
constexpr double kLeastOverVtk = 50;
constexpr double kMostAuto = 1.15;                                 // auto to the best robust method
constexpr int kFramesThatTell = 3;                                 // one frame may have waited for the driver's compiler
constexpr double kLeastPsnr = 90;                                  // dB, lit
constexpr double kAccuracyDigit = 0.1;                             // per cent: the poster's last digit
constexpr double kMorePasses = 1;                                  // ours count the pass that finds nothing

const Entry* entryOf(const std::vector<Entry>& entries, std::string_view method) {
  for (const Entry& e : entries) {
    if (e.method == method && e.measured() && e.frames > 0) return &e;
  }
  return nullptr;
}

bool isHardware(const Entry& e) { return e.method.ends_with("(hardware depth)"); }

// Auto against the fastest robust method of its back end.
void limitAuto(std::vector<Limit>& all, const std::string& scene, const std::vector<Entry>& entries) {
  const Entry* chosen = entryOf(entries, "auto");
  double best = std::numeric_limits<double>::infinity();
  for (const Entry& e : entries) {
    if (e.robust && e.backend == "gl" && e.method != "auto" && !isHardware(e) && e.measured() && e.frames >= kFramesThatTell) best = std::min(best, e.minMs);
  }
  if (chosen && chosen->frames >= kFramesThatTell && std::isfinite(best)) all.push_back({scene, "auto's time to the best robust gl method's", chosen->minMs / best, kMostAuto});
}

// Every robust method delivers everything; the reference's own method nowhere differs from it.
void limitErrors(std::vector<Limit>& all, const SceneRun& scene) {
  double least = 1, wrong = 0, psnr = std::numeric_limits<double>::infinity();
  bool any = false;
  for (const Entry& e : scene.entries) {
    if (!e.robust || !e.measured() || isHardware(e)) continue;
    any = true;
    least = std::min(least, e.stats.rh());
    wrong = std::max(wrong, double(e.error.wrong));
    psnr = std::min(psnr, e.error.psnr);
  }
  if (!any) return;
  all.push_back({scene.name, "least R_h of the robust methods", least, 1, true});
  all.push_back({scene.name, "wrong pixels of the worst robust method", wrong, 0});
  all.push_back({scene.name, "its PSNR, dB", psnr, kLeastPsnr, true});
}

void limitSpeed(std::vector<Limit>& all, const SpeedRun& speed) {
  for (const SpeedScene& scene : speed.scenes) {
    const Entry* tile = entryOf(scene.entries, "tile");
    const Entry* zbuffer = entryOf(scene.entries, "zbuffer");
    const Entry* list = entryOf(scene.entries, kPlainList);
    if (tile && scene.mostMs > 0) all.push_back({scene.name, "tile's ms", tile->minMs, scene.mostMs});
    if (tile && zbuffer) all.push_back({scene.name, "tile's time to the plain z-buffer's", tile->minMs / zbuffer->minMs, scene.mostRatio});
    if (tile && scene.vtkMs > 0) all.push_back({scene.name, "times as fast as VTK's dual peeling", scene.vtkMs / tile->minMs, kLeastOverVtk, true});
    limitAuto(all, scene.name, scene.entries);
    for (const Entry& e : scene.entries) {
      if (list && e.robust && e.backend == "gl" && &e != list && e.measured() && e.frames > 0) all.push_back({scene.name, e.method + "'s time to a plain list's", e.minMs / list->minMs, 1});
    }
  }
}

void limitTable(std::vector<Limit>& all, const std::vector<Row2011>& rows) {
  double accuracy = 0, passes = 0;
  for (const Row2011& r : rows) {
    if (!r.leftOut.empty()) continue;
    accuracy = std::max(accuracy, std::abs(r.accuracy - r.paperAccuracy));
    passes = std::max(passes, std::abs(double(r.passes) - double(r.paperPasses)));
  }
  if (rows.empty()) return;
  all.push_back({"table of 2011", "accuracy off the poster's, %", accuracy, kAccuracyDigit});
  all.push_back({"table of 2011", "passes off the poster's", passes, kMorePasses});
}

// What is wholly peeled is not drawn again.
void limitCulling(std::vector<Limit>& all, const std::vector<Entry>& entries) {
  for (const Entry& e : entries) {
    if (e.method.find("+cull") == std::string::npos || !e.measured() || e.stats.objectsDrawn.empty()) continue;
    all.push_back({"three in a row", e.method + ": objects in the last pass", double(e.stats.objectsDrawn.back()), 2});
  }
}

}  // namespace

double mostMsOf(std::size_t copyCount) { return copyCount == 1 ? kMostBunnyMs : kMostBunniesMs; }
double mostRatioOf(bool hairball) { return hairball ? kMostHairballRatio : kMostRatio; }

std::vector<Limit> limitsOf(const Report& report) {
  std::vector<Limit> all;
  limitSpeed(all, report.speed);
  for (const SceneRun& scene : report.scenes) {
    limitErrors(all, scene);
    limitAuto(all, scene.name, scene.entries);
  }
  limitTable(all, report.table);
  limitCulling(all, report.culling);
  return all;
}

std::string toText(const std::vector<Limit>& limits) {
  if (limits.empty()) return "";
  const auto held = std::count_if(limits.begin(), limits.end(), [](const Limit& limit) { return limit.holds(); });
  std::string text = fmt::format("{} of {} limits hold.\n", held, limits.size());
  for (const Limit& l : limits) {
    if (!l.holds()) text += fmt::format("- {}: {} {:.3g}, to be {} {:.3g}\n", l.subject, l.what, l.value, l.atLeast ? "at least" : "at most", l.limit);
  }
  return text;
}

}  // namespace copeel::bench
