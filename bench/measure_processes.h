// Whole processes, from the command to the picture on disk: ours from .csg and from .scad, and openscad's preview of the same .scad, in turns.
#pragma once

#include <filesystem>
#include <string>

#include "bench/measure_frames.h"
#include "bench/rungs.h"

namespace copeel::bench {

struct ProcessMeasurement {
  Times wall;                        // 0: not measured
  std::uint64_t peakBytes = 0;
  std::string note;                  // what went wrong, if anything; the time is then that of failing
  bool measured() const { return wall.minMs > 0; }
  bool drew() const { return measured() && note.empty(); }
};

struct ProcessLimitsOfRun {
  int rounds = 5;
  double longSeconds = 10;           // what takes longer is run once only
  double giveUpSeconds = 120;
  int threads = 2;
};

struct Programs {
  std::filesystem::path copeel;
  bool openscadPreview = false;      // installed, and has a display
};

struct WholeProcesses {
  ProcessMeasurement fromCsg, fromScad, openscad;
  // 0 where there is nothing to compare: not measured, or no picture.
  double scadSpeedup() const { return openscad.drew() && fromScad.drew() ? openscad.wall.minMs / fromScad.wall.minMs : 0; }
};

// `csg` as evaluate() wrote it, its source beside it.
WholeProcesses measureProcesses(const Rung& rung, const std::filesystem::path& csg, const Programs& programs, const ProcessLimitsOfRun& limits);

// Of a .csg alone.
ProcessMeasurement measureProcess(const std::filesystem::path& csg, const Programs& programs, const ProcessLimitsOfRun& limits);

}  // namespace copeel::bench
