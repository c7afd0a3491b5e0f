#include "bench/measure_processes.h"

#include <algorithm>
#include <vector>

#include "bench/process.h"
#include "core/error.h"

namespace copeel::bench {
namespace {

namespace fs = std::filesystem;

// One program among those that take turns.
class Runner {
 public:
  Runner(std::vector<std::string> command, fs::path picture, const ProcessLimitsOfRun& limits)
      : command_(std::move(command)), picture_(std::move(picture)), limits_(limits) {}

  void run() {
    if (stopped_) return;
    std::error_code ignored;
    fs::remove(picture_, ignored);
    const ProcessRun run = runProcess(command_, {limits_.giveUpSeconds});
    wall_.push_back(run.wallMs);
    peakBytes_ = std::max(peakBytes_, run.peakBytes);
    judge(run);
    stopped_ = !note_.empty() || run.wallMs > limits_.longSeconds * 1000;
  }
  ProcessMeasurement result() const { return {timesOf(wall_), peakBytes_, note_}; }

 private:
  void judge(const ProcessRun& run) {
    if (run.timedOut) note_ = fmt::format("given up after {:.0f} s", limits_.giveUpSeconds);
    else if (run.exitCode != 0) note_ = fmt::format("exit code {}", run.exitCode);
    else if (!fs::exists(picture_)) note_ = "no picture";
    else if (run.errors.find("normalization resulted in an empty tree") != std::string::npos) note_ = "blank picture";
  }

  std::vector<std::string> command_;
  fs::path picture_;
  ProcessLimitsOfRun limits_;
  std::vector<double> wall_;
  std::uint64_t peakBytes_ = 0;
  std::string note_;
  bool stopped_ = false;
};

std::string imageSize() { return fmt::format("{},{}", kWidthPx, kHeightPx); }

Runner copeelRunner(const std::vector<std::string>& input, const fs::path& picture, const Programs& programs, const ProcessLimitsOfRun& limits) {
  std::vector<std::string> command{programs.copeel.string(), "csg", "-o", picture.string(), "--imgsize", imageSize(), "--quiet"};
  command.insert(command.end(), {"--threads", std::to_string(limits.threads)});
  command.insert(command.end(), input.begin(), input.end());
  return Runner(command, picture, limits);
}

Runner openscadRunner(const std::vector<std::string>& input, const fs::path& picture, const ProcessLimitsOfRun& limits) {
  std::vector<std::string> command{"openscad", "-o", picture.string(), "--imgsize", imageSize()};
  command.insert(command.end(), input.begin(), input.end());
  return Runner(command, picture, limits);
}

}  // namespace

WholeProcesses measureProcesses(const Rung& rung, const fs::path& csg, const Programs& programs, const ProcessLimitsOfRun& limits) {
  std::vector<std::string> scad = definitionArguments(rung);
  const fs::path folder = csg.parent_path();
  scad.push_back(sourceIn(rung, folder).string());
  Runner fromCsg = copeelRunner({csg.string()}, folder / "csg.png", programs, limits);
  Runner fromScad = copeelRunner(scad, folder / "scad.png", programs, limits);
  Runner openscad = openscadRunner(scad, folder / "openscad.png", limits);
  for (int round = 0; round < limits.rounds; ++round) {
    fromCsg.run();
    fromScad.run();
    if (programs.openscadPreview) openscad.run();
  }
  return {fromCsg.result(), fromScad.result(), openscad.result()};
}

ProcessMeasurement measureProcess(const fs::path& csg, const Programs& programs, const ProcessLimitsOfRun& limits) {
  Runner runner = copeelRunner({csg.string()}, csg.parent_path() / "csg.png", programs, limits);
  for (int round = 0; round < limits.rounds; ++round) runner.run();
  return runner.result();
}

}  // namespace copeel::bench
