#include "apps/bench/run.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <numeric>

#include <fmt/format.h>

#include "apps/bench/deadline.h"
#include "apps/bench/report.h"
#include "apps/bench/stand_ins.h"
#include "apps/bench/sweeps.h"
#include "apps/command/progress.h"
#include "core/error.h"
#include "core/output_file.h"

namespace copeel::bench {
namespace {

constexpr int kSmallPart = 4;   // of the side of the picture: tables whose counts do not depend on it

class Run {
 public:
  explicit Run(const Options& options)
      : options_(options), parts_(chosenParts(options)), size_(chosenSizes(options)[0]), progress_(!options.quiet), standIns_(options.dataFolder), deadline_(1e3 * options.seconds) {
    measure_.methods = chosenMethods(options);
    measure_.frames = options.frames;
    measure_.threads = options.threads;
  }

  void makeFolders() const;
  void runParts();
  void write();

 private:
  void runPart(std::string_view name, double budgetMs);
  void scenes(double budgetMs);
  void table2011Part(double budgetMs);
  void table2013Part(double budgetMs);
  void speed(double budgetMs);
  void peers(double budgetMs);
  void note(const std::string& text);
  MeasureOptions ofScene(const std::string& name) const;
  std::string folder(const char* name) const { return options_.reportFolder + "/" + name; }
  int small(int side) const { return std::max(1, side / kSmallPart); }

  const Options& options_;
  std::vector<Part> parts_;
  std::array<int, 2> size_;
  Progress progress_;
  StandIns standIns_;
  Deadline deadline_;
  MeasureOptions measure_;
  Report report_;
};

void Run::makeFolders() const {
  for (const char* name : {"pictures", "plots"}) {
    std::error_code error;
    std::filesystem::create_directories(folder(name), error);
    if (error) failMachine("{}: {}", folder(name), error.message());
  }
}

void Run::note(const std::string& text) {
  report_.notes.push_back(text);
  fmt::print("{}\n", text);
}

// What a part leaves of its share, the later ones have.
void Run::runParts() {
  double weights = 0;
  for (const Part& part : parts_) weights += part.weight;
  for (const Part& part : parts_) {
    progress_.phase(std::string(part.title));
    const double budgetMs = deadline_.leftMs() * part.weight / weights;
    weights -= part.weight;
    if (budgetMs <= 0) {
      note(fmt::format("{}: left out: no time is left.", part.title));
      continue;
    }
    // A part that this machine cannot run (no GL) is a line of the report, not its end.
    try {
      runPart(part.name, budgetMs);
    } catch (const Error& error) {
      if (error.code() != ExitCode::Machine) throw;
      note(fmt::format("{}: not run: {}.", part.title, error.what()));
    }
    std::fflush(stdout);
  }
}

void Run::runPart(std::string_view name, double budgetMs) {
  if (name == "scenes") return scenes(budgetMs);
  if (name == "table2011") return table2011Part(budgetMs);
  if (name == "table2013") return table2013Part(budgetMs);
  if (name == "speed") return speed(budgetMs);
  if (name == "peers") return peers(budgetMs);
  sweep(name, options_, standIns_, measure_, budgetMs, report_);
}

// Scenes with coplanar faces by the rasterizer's depth, too: what the papers' source of depth makes of them.
MeasureOptions Run::ofScene(const std::string& name) const {
  MeasureOptions measure = measure_;
  measure.pictureFolder = folder("pictures");
  if (options_.depthSource == "hardware" || !isCoplanar(name, static_cast<std::size_t>(options_.copies))) return measure;
  std::vector<MethodRun> both;
  for (const MethodRun& run : measure_.methods) {
    if (run.label == "ll" || run.label == "f2b") both.push_back(run);
  }
  append(measure.methods, withHardwareDepth(both));
  return measure;
}

// Pictures are those of the first size.
void Run::scenes(double budgetMs) {
  const Deadline deadline(budgetMs);
  const std::vector<std::string>& names = options_.scenes.empty() ? sceneNames() : options_.scenes;
  for (std::size_t i = 0; i < names.size(); ++i) {
    BenchScene scene = sceneOf(names[i], static_cast<std::size_t>(options_.copies));
    if (!options_.camera.camera.empty()) scene.camera = options_.camera;
    progress_.phase(fmt::format("{}: {}", scene.name, scene.title));
    MeasureOptions measure = ofScene(names[i]);
    measure.budgetMs = std::max(0.0, deadline.leftMs()) / double(names.size() - i);
    report_.scenes.push_back({scene.name, scene.title, measureScene(scene, size_[0], size_[1], measure)});
    fmt::print("{}\n", toText(report_.scenes.back().entries));
    std::fflush(stdout);
  }
  if (const std::string text = depthSourcesToText(report_); !text.empty()) fmt::print("{}\n", text);
}

void Run::table2011Part(double budgetMs) {
  Options2011 options;
  options.width = small(size_[0]), options.height = small(size_[1]);
  options.budgetMs = budgetMs;
  if (!findMethod("f2b-kb-zf")) failMachine("the gl back end is not in this build");
  report_.table = table2011(options);
  fmt::print("{}\n", toText(report_.table));
}

void Run::table2013Part(double budgetMs) { report_.table2013 = table2013(small(size_[0]), small(size_[1]), options_.k, 1, budgetMs); }

void Run::speed(double budgetMs) {
  report_.speed = measureSpeed(standIns_, {options_.backend, options_.frames, budgetMs, !options_.noPeer});
  fmt::print("{}\n", toText(report_.speed));
}

void Run::peers(double budgetMs) {
  if (options_.noPeer) {
    report_.peerNote = "Not run: --no-peer.";
    return;
  }
  const Deadline deadline(budgetMs);
  const BenchScene one = standIns_.peer();
  for (const std::size_t count : {1u, 4u, 12u}) {
    if (deadline.leftMs() < 0) {
      report_.peerNote += fmt::format(" Left out with {} copies: no time is left.", count);
      continue;
    }
    const auto entry = runVtk({one.parts.front().mesh.get(), count, size_[0], size_[1], std::max(3, options_.frames), options_.threads}, report_.peerNote);
    if (!entry) break;
    report_.peers.push_back(*entry);
    fmt::print("{:<8} {} copies: {:.2f} ms, R_h {:.4f}; tile {:.2f} ms\n", entry->name, entry->copies, entry->minMs, entry->rh, entry->tileMs);
  }
  fmt::print("{}\n", report_.peerNote);
}

void Run::write() {
  progress_.phase("the report");
  drawPlots(report_, folder("plots"));
  writeFile(options_.reportFolder + "/bench.json", toJson(report_));
  writeFile(options_.reportFolder + "/index.html", toHtml(report_));
  if (!report_.plotNote.empty()) fmt::print("{}\n", report_.plotNote);
  fmt::print("{}{}/index.html\n", toText(limitsOf(report_)), options_.reportFolder);
}

}  // namespace

void runReport(const Options& options) {
  Run run(options);
  run.makeFolders();
  run.runParts();
  run.write();
}

}  // namespace copeel::bench
