// VTK's dual depth peeling on the scene and camera of ours, in a process of its own (python3 with vtk), timed in the same run.
// How many fragments it kept is told from its picture: of n layers of one colour and opacity a pixel has 1 - (1 - a)^n.
#pragma once

#include <optional>
#include <string>

#include "apps/bench/scenes.h"

namespace copeel::bench {

struct PeerEntry {
  std::string name;
  std::size_t copies = 0;
  double minMs = 0, medianMs = 0;
  double rh = 0;                  // fragments told from the picture / fragments
  double tileMs = 0;              // of ours, the same scene and size
};

// A mesh, how often it is drawn, and how; by both for kEnoughMs (measure.h), and so many frames at least.
struct VtkJob {
  const Mesh* mesh;
  std::size_t copies;
  int width, height, frames, threads;   // threads: of ours
};

// Nothing where it cannot run; `note` says why, or what ran.
std::optional<PeerEntry> runVtk(const VtkJob& job, std::string& note);

}  // namespace copeel::bench
