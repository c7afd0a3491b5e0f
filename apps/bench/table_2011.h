// The table of the 2011 poster, from a run: 1, 4, 8 and 12 coincident copies of closed shells of 8 layers, three methods, K = 8.
// Based on: Vasilakis, Fudos. Z-fighting aware depth peeling. SIGGRAPH 2011 posters, table 1.
// The scene is ours (the poster's bunny seen so that it has 8 layers); what is compared does not depend on the shape.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/measure.h"

namespace copeel::bench {

struct Row2011 {
  std::string method;
  std::size_t copies = 0;
  std::uint64_t peeled = 0, paperPeeled = 0;       // fragments of the fullest pixel
  double accuracy = 0, paperAccuracy = 0;          // per cent of all fragments
  std::uint64_t passes = 0, paperPasses = 0;       // ours count the pass that finds nothing more
  double ms = 0;
};

// Throws Error{Machine}: no GL.
std::vector<Row2011> table2011(int width, int height, int frames);
std::string toText(const std::vector<Row2011>& rows);

}  // namespace copeel::bench
