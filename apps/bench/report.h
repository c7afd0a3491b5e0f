// What a run of the bench found, and how it is written: bench.json, index.html with its plots and pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/bench/limits.h"
#include "apps/bench/measure.h"
#include "apps/bench/peer_vtk.h"
#include "apps/bench/speed.h"
#include "apps/bench/table_2011.h"
#include "apps/bench/table_2013.h"

namespace copeel::bench {

struct SceneRun {
  std::string name, title;
  std::vector<Entry> entries;
};

// A sweep, and what it is of.
struct Sweep {
  std::string of;                          // for captions: the scene
  std::vector<Entry> entries;
};

struct Plot {
  std::string file, caption;
};

struct Report {
  std::vector<SceneRun> scenes;            // all methods
  Sweep overResolution, overCopies, overDepth, memory;
  bool depthByScene = false;               // overDepth holds scenes, not shells in one another
  Sweep limitedMemory;                     // of the same scenes
  std::uint64_t memoryLimit = 0;           // bytes, of limitedMemory
  std::vector<Entry> culling;
  std::string cullingOf;
  std::vector<Row2011> table;
  std::optional<Table2013> table2013;
  SpeedRun speed;
  std::vector<PeerEntry> peers;            // VTK, over copies
  std::string peerNote;                    // why there are none, or what they are
  std::string plotNote;                    // why there are no plots
  std::vector<Plot> plots;                 // in plots/, in the page's order
  std::vector<std::string> notes;          // parts that could not run
};

std::string machineLine();

std::string toText(const std::vector<Entry>& entries);
std::string depthSourcesToText(const Report& report);   // planes against hardware; empty where nothing was drawn by hardware depth
std::string toJson(const Report& report);
std::string toJson(const std::vector<Row2011>& rows);
std::string toJson(const Table2013& table);
std::string toHtml(const Report& report);

// One line of the comparison of the sources of depth: the same method on the same scene with both.
struct DepthSources {
  const Entry* planes;
  const Entry* hardware;
};
std::vector<DepthSources> depthSourcesOf(const std::vector<Entry>& entries);

// For tables: "∞" where nothing differs; lengths with two digits.
std::string decibels(double psnr);
std::string lengthOf(double depth);

// Plots of what the report holds, as FOLDER/NAME.svg by gnuplot; fills plots, or plotNote where there is no gnuplot.
void drawPlots(Report& report, const std::string& folder);

}  // namespace copeel::bench
