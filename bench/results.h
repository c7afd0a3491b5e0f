// All that a run of the ladder found, the limits it is held against, and how it is written: text, Markdown, JSON.
#pragma once

#include <string>
#include <vector>

#include "bench/generated_scenes.h"
#include "bench/machine.h"
#include "bench/measure_frames.h"
#include "bench/measure_processes.h"
#include "bench/rungs.h"
#include "bench/table.h"

namespace copeel::bench {

struct RungResult {
  Rung rung;
  FrameMeasurement frames;
  WholeProcesses processes;
};

struct ScalingResult {
  int holes = 0;
  Sight sight = Sight::Open;
  FrameMeasurement frames;
  ProcessMeasurement process;
};

struct Results {
  Machine machine;
  int threads = 2;
  std::vector<RungResult> rungs;
  std::vector<std::string> leftOut;   // rungs that could not be measured
  std::vector<ScalingResult> scaling;
};

// A figure that has to stay on one side of a limit. Reported, never a reason to fail: the machine may be busy.
struct Check {
  std::string subject;        // a rung, or a number of holes
  std::string what;
  double value = 0, limit = 0;
  bool atLeast = false;       // the limit is a least, not a most
  bool met() const { return atLeast ? value >= limit : value <= limit; }
};
std::vector<Check> checks(const Results& results);

// Peak memory of a process less what the picture and the program itself may take, per triangle.
double bytesPerTriangle(const ProcessMeasurement& process, const FrameMeasurement& frames);

std::string toText(const Results& results);
std::string toMarkdown(const Results& results);
std::string toJson(const Results& results);

}  // namespace copeel::bench
