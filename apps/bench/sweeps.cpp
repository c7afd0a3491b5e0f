#include "apps/bench/sweeps.h"

#include <algorithm>
#include <iterator>
#include <map>

#include <fmt/ranges.h>

#include "apps/bench/deadline.h"
#include "core/methods/method.h"

namespace copeel::bench {
namespace {

using Names = std::vector<std::string>;

// The methods of each figure, and the cpu back end's; where methods were asked for, those.
const Names kOfResolution = {"tile", "ll", "f2b", "f2b2", "f2b-2p", "f2b-3p", "f2b-ll", "f2b-fab", "dual", "dual-2p", "dual-ll", "dual-fab"};
const Names kOfCoplanarity = {"tile", "ll", "f2b-2p", "f2b-3p", "f2b-ll", "f2b-fab", "dual-2p", "dual-ll", "dual-fab", "hybrid"};
const Names kOfDepth = {"tile", "f2b", "bun-ll", "fab", "ll", "sb"};
const Names kOfMemory = {"bun-ll", "fab", "ll", "sb", "f2b-2p", "f2b-3p", "f2b-ll", "f2b-kb", "dual-2p", "dual-ll"};
const Names kOfCulling = {"f2b", "f2b+cull", "f2b2", "f2b2+cull", "f2b-3p", "f2b-3p+cull"};
constexpr int kLargestSide = 16384;
constexpr std::size_t kCopies[] = {1, 2, 4, 8, 12};
constexpr std::array<unsigned, 2> kStacks[] = {{2, 1}, {4, 1}, {4, 2}, {4, 4}, {8, 4}, {8, 8}};   // depths, coplanar fragments at each
constexpr std::uint64_t kLimitPerPixel = 100;   // bytes: between what the least and the most of the stacks take

// A line for each reason, with the methods that have it.
void sayWhatIsMissing(const std::vector<Entry>& entries) {
  std::map<std::string, std::vector<std::string>> missing;
  for (const Entry& e : entries) {
    if (!e.measured()) missing[e.failure + e.leftOut].push_back(e.method);
  }
  for (const auto& [why, methods] : missing) fmt::print("{}, {} x {}: {}: {}\n", entries[0].scene, entries[0].width, entries[0].height, fmt::join(methods, ", "), why);
}

class Sweeper {
 public:
  Sweeper(const Options& options, const StandIns& standIns, const MeasureOptions& measure, double budgetMs, Report& report)
      : options_(options), standIns_(standIns), measure_(measure), deadline_(budgetMs), size_(chosenSizes(options)[0]), report_(report) {
    measure_.pictureFolder.clear();
  }

  void resolution();
  void coplanarity();
  void depth();
  void culling();
  void memory();

 private:
  void choose(const Names& names) {
    if (options_.methods.empty()) measure_.methods = runsThatAre(names, options_.backend, options_.k);
    if (options_.methods.empty() && options_.depthSource == "hardware") measure_.methods = withHardwareDepth(measure_.methods);
  }
  // The next of so many steps that are left, each with its part of the time.
  void add(Sweep& sweep, const BenchScene& scene, std::array<int, 2> size, double parameter, std::size_t stepsLeft);

  const Options& options_;
  const StandIns& standIns_;
  MeasureOptions measure_;
  Deadline deadline_;
  std::array<int, 2> size_;
  Report& report_;
};

void Sweeper::add(Sweep& sweep, const BenchScene& scene, std::array<int, 2> size, double parameter, std::size_t stepsLeft) {
  measure_.budgetMs = std::max(0.0, deadline_.leftMs()) / double(stepsLeft);
  std::vector<Entry> entries = measureScene(scene, size[0], size[1], measure_);
  sayWhatIsMissing(entries);
  for (Entry& entry : entries) {
    entry.parameter = parameter;
    sweep.entries.push_back(std::move(entry));
  }
}

// The sizes asked for, or a half, one and two of the side.
void Sweeper::resolution() {
  choose(kOfResolution);
  const auto [width, height] = size_;
  std::vector<std::array<int, 2>> sizes = chosenSizes(options_);
  if (sizes.size() == 1) sizes = {{std::max(1, width / 2), std::max(1, height / 2)}, {width, height}, {std::min(2 * width, kLargestSide), std::min(2 * height, kLargestSide)}};
  const BenchScene scene = standIns_.crank();
  report_.overResolution.of = scene.title;
  // The largest takes most of the time: each is given a share as if those before it were half of it.
  for (std::size_t i = 0; i < sizes.size(); ++i) add(report_.overResolution, scene, sizes[i], 0, std::size_t{1} << (sizes.size() - 1 - i));
}

void Sweeper::coplanarity() {
  choose(kOfCoplanarity);
  for (std::size_t i = 0; i < std::size(kCopies); ++i) {
    const BenchScene scene = standIns_.fandisk(kCopies[i]);
    report_.overCopies.of = scene.title;
    add(report_.overCopies, scene, size_, double(kCopies[i]), std::size(kCopies) - i);
  }
}

void Sweeper::depth() {
  choose(kOfDepth);
  const std::vector<BenchScene> scenes = standIns_.deep();
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    report_.overDepth.of += (standIns_.areFiles() && i ? ", " : "") + (standIns_.areFiles() || i == 0 ? scenes[i].title : "");
    add(report_.overDepth, scenes[i], size_, double(std::size_t{1} << i), scenes.size() - i);
  }
  report_.depthByScene = standIns_.areFiles();
}

void Sweeper::culling() {
  measure_.methods = runsThatAre(kOfCulling, options_.backend, options_.k);
  const BenchScene scene = standIns_.dragons();
  report_.cullingOf = scene.title;
  Sweep culled;
  add(culled, scene, size_, 0, 1);
  report_.culling = std::move(culled.entries);
}

// Each scene twice: with what memory the methods want, and with a limit that the larger scenes exceed.
void Sweeper::memory() {
  choose(kOfMemory);
  std::erase_if(measure_.methods, [](const MethodRun& run) { return run.method->backend != "gl"; });
  measure_.frames = 1;
  report_.memory.of = "generated rectangles, of 2 to 64 fragments in half of the pixels (2 to 8 depths of 1 to 8 coplanar ones)";
  report_.memoryLimit = kLimitPerPixel * static_cast<std::uint64_t>(size_[0]) * static_cast<std::uint64_t>(size_[1]);
  const std::size_t count = measure_.methods.size();
  std::vector<MethodRun> limited = measure_.methods;
  for (MethodRun& run : limited) run.options.memoryBytes = report_.memoryLimit;
  append(measure_.methods, limited);
  for (std::size_t i = 0; i < std::size(kStacks); ++i) {
    Sweep both;
    add(both, stack(kStacks[i][0], kStacks[i][1]), size_, 0, std::size(kStacks) - i);
    for (std::size_t e = 0; e < both.entries.size(); ++e) (e < count ? report_.memory : report_.limitedMemory).entries.push_back(both.entries[e]);
  }
}

}  // namespace

void sweep(std::string_view part, const Options& options, const StandIns& standIns, const MeasureOptions& measure, double budgetMs, Report& report) {
  Sweeper sweeper(options, standIns, measure, budgetMs, report);
  if (part == "resolution") sweeper.resolution();
  if (part == "coplanarity") sweeper.coplanarity();
  if (part == "depth") sweeper.depth();
  if (part == "culling") sweeper.culling();
  if (part == "memory") sweeper.memory();
}

}  // namespace copeel::bench
