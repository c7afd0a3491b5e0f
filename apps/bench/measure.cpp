#include "apps/bench/measure.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "apps/bench/deadline.h"
#include "apps/bench/subject.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

constexpr const char* kNoTime = "left out: no time is left";
// In the first frame of a turn a method finds the caches and the page tables as others left them, some of whom have buffers in common with it.
constexpr int kFramesOfATurn = 2;
constexpr std::size_t kLeastFrames = 4;    // also of those that take long: a first one may be of a second, for the system's pages that buffers are made of
constexpr double kFramesToWarm = 4;        // two frames, the counts, which are another one, and one that is timed
constexpr double kPassesThatTell = 3;      // a method of so many tells the time of a pass; of fewer, other work takes as long

// The methods of one source of depth on one scene.
class Turns {
 public:
  Turns(Subject& subject, const std::vector<MethodRun>& runs, const MeasureOptions& options, const Deadline& deadline)
      : subject_(subject), runs_(runs), options_(options), deadline_(deadline) {}

  void warm(std::vector<Entry*> entries);
  void time();

 private:
  double expectedMs(std::size_t i) const;
  void warmOne(std::size_t i);

  Subject& subject_;
  const std::vector<MethodRun>& runs_;
  const MeasureOptions& options_;
  const Deadline& deadline_;
  std::vector<Entry*> entries_;
  std::vector<double> passes_, leastMs_;   // expected passes; of frames, least so far
  double owedMs_ = 0;                      // one timed frame of each method so far
  double tellingMs_ = 0, tellingPasses_ = 0;   // of the methods of many passes so far
  double passMs_ = 0;                          // one of theirs; before there is any, by the methods of few; 0: none yet
};

double Turns::expectedMs(std::size_t i) const { return runs_[i].method->backend == "gl" ? passes_[i] * passMs_ : 0; }

// A method that this machine cannot run (no GL, no memory) is a line of the report, not its end.
void Turns::warmOne(std::size_t i) {
  Entry& entry = *entries_[i];
  const double left = deadline_.leftMs() - owedMs_, expected = expectedMs(i);
  if (kFramesToWarm * expected > left || left <= 0) {
    entry.leftOut = expected > 0 && left > 0 ? fmt::format("left out: {:.0f} pass{} would take {:.1f} s a frame, and {:.1f} s are left", passes_[i], passes_[i] == 1 ? "" : "es", expected / 1e3, left / 1e3)
                                             : kNoTime;
    return;
  }
  try {
    leastMs_[i] = subject_.warm(runs_[i], entry);
  } catch (const Error& error) {
    if (error.code() != ExitCode::Machine) throw;
    entry.failure = error.what();
    return;
  }
  owedMs_ += leastMs_[i];
  if (entry.backend != "gl") return;
  if (double(entry.stats.passes) >= kPassesThatTell) {
    tellingMs_ += leastMs_[i];
    tellingPasses_ += double(entry.stats.passes);
    passMs_ = tellingMs_ / tellingPasses_;
  } else if (tellingPasses_ == 0) {
    passMs_ = leastMs_[i] / kPassesThatTell;
  }
}

void Turns::warm(std::vector<Entry*> entries) {
  entries_ = std::move(entries);
  leastMs_.resize(runs_.size());
  for (const MethodRun& run : runs_) passes_.push_back(expectedPasses(run.method->name, subject_.shape(), run.options.k));
  std::vector<std::size_t> order(runs_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return passes_[a] < passes_[b]; });
  for (const std::size_t i : order) warmOne(i);
}

void Turns::time() {
  std::vector<std::vector<double>> times(runs_.size());
  const auto mayDraw = [&](std::size_t i) {
    if (!entries_[i]->measured()) return false;
    if (times[i].size() >= kLeastFrames && std::accumulate(times[i].begin(), times[i].end(), 0.0) > kEnoughMs) return false;
    // The first frame was paid for when the method was let in.
    return times[i].empty() || leastMs_[i] <= deadline_.leftMs();
  };
  for (int frame = 0; frame < options_.frames; frame += kFramesOfATurn) {
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      for (int more = 0; more < std::min(kFramesOfATurn, options_.frames - frame) && mayDraw(i); ++more) times[i].push_back(subject_.time(runs_[i], *entries_[i]));
    }
  }
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    std::vector<double>& ms = times[i];
    if (ms.empty()) continue;
    std::sort(ms.begin(), ms.end());
    entries_[i]->frames = static_cast<int>(ms.size());
    entries_[i]->minMs = ms.front();
    entries_[i]->medianMs = (ms[ms.size() / 2] + ms[(ms.size() - 1) / 2]) / 2;
  }
}

// One after the other the two sources of depth, each with all its methods in turns.
std::vector<Entry> run(const BenchScene& scene, int width, int height, const MeasureOptions& options, bool compares) {
  Deadline deadline(options.budgetMs);
  std::vector<Entry> entries;
  for (const MethodRun& run : options.methods) {
    Entry entry;
    entry.scene = scene.name, entry.method = run.label, entry.backend = run.method->backend, entry.robust = run.method->robust;
    entry.width = width, entry.height = height;
    entries.push_back(std::move(entry));
  }
  for (const bool hardware : {false, true}) {
    std::vector<MethodRun> runs;
    std::vector<Entry*> theirs;
    for (std::size_t i = 0; i < entries.size(); ++i) {
      if (options.methods[i].options.hardwareDepth != hardware) continue;
      runs.push_back(options.methods[i]);
      theirs.push_back(&entries[i]);
    }
    if (runs.empty()) continue;
    if (deadline.leftMs() <= 0) {
      for (Entry* entry : theirs) entry->leftOut = kNoTime;
      continue;
    }
    // The budget is the methods': what it takes to know what is right does not count.
    const Deadline setUp;
    Subject subject(scene, width, height, options, hardware, compares);
    deadline.extend(setUp.passedMs());
    Turns turns(subject, runs, options, deadline);
    turns.warm(theirs);
    turns.time();
  }
  return entries;
}

}  // namespace

std::string fileNameOf(const std::string& method) {
  std::string name = method;
  for (char& c : name) {
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '-' && c != '_') c = '_';
  }
  return name;
}

std::vector<Entry> measureScene(const BenchScene& scene, int width, int height, const MeasureOptions& options) { return run(scene, width, height, options, true); }
std::vector<Entry> timeScene(const BenchScene& scene, int width, int height, const MeasureOptions& options) { return run(scene, width, height, options, false); }

}  // namespace copeel::bench
