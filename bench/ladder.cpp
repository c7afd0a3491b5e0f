// ladder: climbs the rungs (bench/rungs.h), measures frames and whole processes, prints tables, writes docs/benchmarks.md.
//
// Each rung's frames are measured in a process of its own, this program started with --measure, for two reasons: no rung leaves its memory
// to the next, and the peak memory of the programs started from here begins with the peak of this one (Linux hands it on).
#include <algorithm>
#include <fstream>
#include <iterator>
#include <memory>

#include <CLI/CLI.hpp>

#include "bench/process.h"
#include "bench/results.h"
#include "bench/work_folder.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

namespace fs = std::filesystem;

struct Options {
  std::vector<std::string> rungs;
  int mostHoles = 100'000;
  bool quick = false;
  bool withoutOpenscad = false;
  std::string copeel, markdownFile, jsonFile;
  FrameLimits frames;
  ProcessLimitsOfRun processes;
  std::string measuredFile, measurementFile;    // --measure, of the child
};

void declare(CLI::App& app, Options& options) {
  app.add_option("--rungs", options.rungs, "only these, as in a,c,h64")->delimiter(',');
  app.add_option("--holes", options.mostHoles, "the largest plate of the scaling table, 0 for none")->capture_default_str();
  app.add_flag("--quick", options.quick, "one round, three frames, no scaling, no openscad preview: to see that it works");
  app.add_flag("--no-openscad", options.withoutOpenscad, "leaves openscad's preview out");
  app.add_option("--frames", options.frames.frames, "of each method")->capture_default_str();
  app.add_option("--rounds", options.processes.rounds, "of whole processes")->capture_default_str();
  app.add_option("--threads", options.frames.threads)->capture_default_str();
  app.add_option("--copeel", options.copeel, "the program, where it is not in ../bin");
  app.add_option("--markdown", options.markdownFile, "writes the tables there")->type_name("FILE");
  app.add_option("--json", options.jsonFile, "writes all figures there")->type_name("FILE");
  app.add_option("--measure", options.measuredFile)->group("");
  app.add_option("--measurement", options.measurementFile)->group("");
}

void settle(Options& options) {
  options.processes.threads = options.frames.threads;
  if (!options.quick) return;
  options.frames.frames = kLeastFrames;
  options.frames.seconds = 0;
  options.processes.rounds = 1;
  options.mostHoles = 0;
  options.withoutOpenscad = true;
}

void write(const std::string& file, const std::string& text) {
  if (file.empty()) return;
  std::ofstream stream(file, std::ios::binary);
  stream << text;
  if (!stream.flush()) failMachine("{}: could not be written", file);
}

std::string read(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

FrameMeasurement measureApart(const fs::path& csg, const Options& options, const WorkFolder& work) {
  const fs::path file = work.path() / "measurement.json";
  std::vector<std::string> command{fs::read_symlink("/proc/self/exe").string(), "--measure", csg.string(), "--measurement", file.string()};
  command.insert(command.end(), {"--threads", std::to_string(options.frames.threads), "--frames", std::to_string(options.frames.frames)});
  if (options.quick) command.push_back("--quick");
  constexpr double kGiveUpSeconds = 600;
  const ProcessRun run = runProcess(command, {kGiveUpSeconds});
  if (run.exitCode != 0) failMachine("{}: not measured, exit code {}: {}", csg.filename().string(), run.exitCode, run.errors);
  return frameMeasurementOf(read(file));
}

fs::path findCopeel(const Options& options) {
  const fs::path program =
      options.copeel.empty() ? fs::read_symlink("/proc/self/exe").parent_path().parent_path() / "bin" / "copeel" : fs::path(options.copeel);
  if (!fs::exists(program)) failUsage("{}: not there; --copeel names the program", program.string());
  return program;
}

void climb(const Options& options, const Programs& programs, const WorkFolder& work, Results& results) {
  const RungFolders folders = defaultFolders();
  for (const Rung& rung : chosenRungs(folders, options.rungs)) {
    fmt::print(stderr, "{}: {}\n", rung.name, rung.title);
    // A rung that cannot be measured does not take the others with it.
    try {
      const fs::path csg = evaluate(rung, folders, work.path());
      const WholeProcesses processes = measureProcesses(rung, csg, programs, options.processes);
      results.rungs.push_back({rung, measureApart(csg, options, work), processes});
    } catch (const Error& error) {
      if (error.code() == ExitCode::Usage) throw;
      fmt::print(stderr, "{}: left out: {}\n", rung.name, error.what());
      results.leftOut.push_back(rung.name);
    }
  }
}

void scale(const Options& options, const Programs& programs, const WorkFolder& work, Results& results) {
  for (Sight sight : {Sight::Open, Sight::Boxed}) {
    for (int holes = 100; holes <= options.mostHoles; holes *= 10) {
      fmt::print(stderr, "{} holes\n", holes);
      const fs::path csg = work.path() / "holes.csg";
      writeCsg(plateOf(holes, sight), csg);
      const ProcessMeasurement process = measureProcess(csg, programs, options.processes);
      results.scaling.push_back({holes, sight, measureApart(csg, options, work), process});
    }
  }
}

void run(Options& options) {
  settle(options);
  if (!options.measuredFile.empty()) {
    write(options.measurementFile, toJson(measureFrames(options.measuredFile, options.frames)));
    return;
  }
  Results results;
  results.machine = describeMachine();
  results.threads = options.frames.threads;
  Programs programs{findCopeel(options), false};
  const bool preview = !options.withoutOpenscad && isInstalled("openscad") && isInstalled("Xvfb");
  const std::unique_ptr<XServer> display = preview ? std::make_unique<XServer>() : nullptr;
  programs.openscadPreview = display && display->running();

  const WorkFolder work;
  climb(options, programs, work, results);
  scale(options, programs, work, results);
  fmt::print("{}", toText(results));
  write(options.markdownFile, toMarkdown(results));
  write(options.jsonFile, toJson(results));
}

}  // namespace
}  // namespace copeel::bench

int main(int argc, char** argv) {
  CLI::App app("Frames and whole processes on the ladder of benchmark models");
  copeel::bench::Options options;
  copeel::bench::declare(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    copeel::bench::run(options);
  } catch (const copeel::Error& error) {
    fmt::print(stderr, "ladder: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
