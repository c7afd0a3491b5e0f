// The table of the 2011 poster, from a run: 1, 4, 8 and 12 coincident copies of closed shells of 8 layers, three methods, K = 8.
// Based on: Vasilakis, Fudos. Z-fighting aware depth peeling. SIGGRAPH 2011 posters, table 1.
// The scene is generated, or a mesh and a camera from which it has 8 layers, as the poster's bunny had. What is compared does not depend on the shape where every
// pixel's depths have equally many fragments. Peeled fragments and passes are those of the fullest pixel; accuracy is fragments delivered / fragments, both of
// all pixels together.
#pragma once

#include <limits>
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
  std::string leftOut;                             // its time
};

struct Options2011 {
  int width = 256, height = 192, frames = 1;
  double budgetMs = std::numeric_limits<double>::infinity();
  std::string mesh;                                // a file; empty: the generated shells
  CameraOptions camera;                            // of the file
};

// Throws Error{Machine}: no GL.
std::vector<Row2011> table2011(const Options2011& options);
inline constexpr const char* kLegend2011 =
    "Peeled and passes: of the fullest pixel. Accuracy: fragments delivered / fragments, both of all pixels together. Passes of ours: f2b and f2b-kb-zf take one more, "
    "which finds that nothing is left.";
std::string toText(const std::vector<Row2011>& rows);

}  // namespace copeel::bench
