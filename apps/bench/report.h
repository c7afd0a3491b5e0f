// What a run of the bench found, and how it is written: bench.json, index.html with its plots and pictures.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "apps/bench/measure.h"
#include "apps/bench/peer_vtk.h"
#include "apps/bench/table_2011.h"

namespace copeel::bench {

struct SceneRun {
  std::string name, title;
  std::vector<Entry> entries;
};

struct Report {
  std::vector<SceneRun> scenes;            // all methods
  std::vector<Entry> overResolution, overCopies, overShells, culling;
  std::vector<Row2011> table;
  std::vector<PeerEntry> peers;            // VTK, over copies
  std::string peerNote;                    // why there are none, or what they are
  std::string plotNote;                    // why there are no plots
  std::vector<std::string> plots;          // files in plots/, in the page's order
};

std::string toText(const std::vector<Entry>& entries);
std::string toJson(const Report& report);
std::string toHtml(const Report& report);

// Plots of what the report holds, as FOLDER/NAME.svg by gnuplot; fills plots, or plotNote where there is no gnuplot.
void drawPlots(Report& report, const std::string& folder);

}  // namespace copeel::bench
