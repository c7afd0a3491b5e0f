// The part that the project's limits of speed are judged by: 1280x720, two threads, a picture alone a frame. The bunny and twelve coincident ones (or a
// generated body of as many triangles) and a hairball of a million triangles, by `tile`, the plain z-buffer and the gl back end's robust single-pass methods.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/measure.h"
#include "apps/bench/peer_vtk.h"
#include "apps/bench/stand_ins.h"

namespace copeel::bench {

// A straightforward linked list on the gl back end, to compare the robust methods with, where this build has one.
inline constexpr const char* kPlainList = "ll-plain";

struct SpeedScene {
  std::string name, title;
  double mostMs = 0, mostRatio = 0;       // limits of tile: its ms (0: none), its time to the z-buffer's
  std::vector<Entry> entries;
  double vtkMs = 0;                       // of VTK's dual depth peeling; 0: not measured
};

struct SpeedRun {
  std::vector<SpeedScene> scenes;
  std::string peerNote;
};

struct SpeedOptions {
  std::string backend = "auto";
  int frames = 3;
  double budgetMs = 0;
  bool withPeer = true;
};

SpeedRun measureSpeed(const StandIns& standIns, const SpeedOptions& options);
std::string toText(const SpeedRun& run);

}  // namespace copeel::bench
