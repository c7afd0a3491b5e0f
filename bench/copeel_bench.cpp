// Frames, preparation and parsing of every rung on Google Benchmark: copeel_bench [--rungs=a,b] [Google Benchmark's options].
//
// A repetition is one call, repetitions of all benchmarks are shuffled together, and minimum and median are reported: on a shared machine
// only what ran in turns can be compared. The tables of docs/benchmarks.md come from `ladder`, which also starts whole processes.
#include <algorithm>
#include <memory>
#include <sstream>

#include <benchmark/benchmark.h>

#include "apps/csg/read_model.h"
#include "bench/measure_frames.h"
#include "bench/rungs.h"
#include "bench/work_folder.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

constexpr int kThreads = 2;
constexpr int kRepetitions = 25;

// What all benchmarks of a rung share. Only the rungs that run are read, when they first do.
class Subject {
 public:
  Subject(const Rung& rung, const RungFolders& folders, const WorkFolder& work) : rung_(rung), folders_(folders), work_(work) {}

  const std::string& file() {
    if (file_.empty()) file_ = evaluate(rung_, folders_, work_.path()).string();
    return file_;
  }
  const csg::Model& model() {
    if (!model_) model_ = std::make_unique<csg::Model>(csg::readCsg(file(), {}));
    return *model_;
  }
  FramePair& frames() {
    if (!frames_) frames_ = std::make_unique<FramePair>(model(), kThreads);
    return *frames_;
  }

 private:
  const Rung& rung_;
  const RungFolders& folders_;
  const WorkFolder& work_;
  std::string file_;
  std::unique_ptr<csg::Model> model_;
  std::unique_ptr<FramePair> frames_;
};

template <class Work>
void registerOne(const std::string& name, Work work) {
  benchmark::RegisterBenchmark(name.c_str(), work)
      ->Iterations(1)
      ->Repetitions(kRepetitions)
      ->UseRealTime()
      ->Unit(benchmark::kMillisecond)
      ->ReportAggregatesOnly()
      ->ComputeStatistics("min", [](const std::vector<double>& ms) { return *std::min_element(ms.begin(), ms.end()); });
}

void registerAll(Subject& subject, const std::string& rung) {
  registerOne("zbuffer/" + rung, [&](benchmark::State& state) {
    FramePair& frames = subject.frames();
    for (auto _ : state) frames.drawZbuffer();
  });
  registerOne("csg/" + rung, [&](benchmark::State& state) {
    FramePair& frames = subject.frames();
    for (auto _ : state) frames.drawCsg();
    state.counters["fragments"] = static_cast<double>(frames.stats().fragments);
    state.counters["triangles"] = static_cast<double>(frames.stats().triangles);
  });
  registerOne("prepare/" + rung, [&](benchmark::State& state) {
    const csg::Model& model = subject.model();
    for (auto _ : state) csg::Renderer renderer(model, renderOptions("tile", kThreads));
  });
  registerOne("parse/" + rung, [&](benchmark::State& state) {
    const std::string& file = subject.file();
    for (auto _ : state) benchmark::DoNotOptimize(csg::readCsg(file, {}));
  });
}

// Takes --rungs=… out of the arguments.
std::vector<std::string> rungNames(std::vector<char*>& arguments) {
  constexpr std::string_view kOption = "--rungs=";
  std::vector<std::string> names;
  std::erase_if(arguments, [&](const char* argument) {
    if (!std::string_view(argument).starts_with(kOption)) return false;
    std::istringstream list(argument + kOption.size());
    for (std::string name; std::getline(list, name, ',');) names.push_back(name);
    return true;
  });
  return names;
}

int run(std::vector<char*> arguments) {
  const RungFolders folders = defaultFolders();
  const std::vector<Rung> rungs = chosenRungs(folders, rungNames(arguments));
  // What the user says comes later and wins.
  char interleaving[] = "--benchmark_enable_random_interleaving=true";
  arguments.insert(arguments.begin() + 1, interleaving);
  int count = static_cast<int>(arguments.size());
  benchmark::Initialize(&count, arguments.data());
  if (benchmark::ReportUnrecognizedArguments(count, arguments.data())) return static_cast<int>(ExitCode::Usage);

  const WorkFolder work;
  std::vector<std::unique_ptr<Subject>> subjects;
  for (const Rung& rung : rungs) {
    subjects.push_back(std::make_unique<Subject>(rung, folders, work));
    registerAll(*subjects.back(), rung.name);
  }
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
}

}  // namespace
}  // namespace copeel::bench

int main(int argc, char** argv) {
  try {
    return copeel::bench::run(std::vector<char*>(argv, argv + argc));
  } catch (const copeel::Error& error) {
    fmt::print(stderr, "copeel_bench: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
