// Table 1 of the 2013 paper as measured: passes, memory, share of the fragments and layers an iteration of every method of the gl back end, by formula and by a run.
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, table 1.
// The scene is generated so that formulas are exact: half of the pixels have D depths of C coplanar fragments each, the others none.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "apps/bench/measure.h"

namespace copeel::bench {

struct Row2013 {
  std::string method;
  std::string passesFormula, paperWords, rhFormula;                       // as the registry has them
  double passesExpected = 0, wordsExpected = 0, rhExpected = 0;           // negative: no number
  std::uint64_t passes = 0;
  double words = 0, rh = 0, layersPerIteration = 0, ms = 0;               // words of 32 bits a pixel; layers negative: unknown
  std::string leftOut;                                                    // its time, or the machine
};

struct Table2013 {
  unsigned depths = 4, coplanar = 12;
  std::uint32_t k = 8;
  int width = 0, height = 0;
  std::vector<Row2013> rows;
};

// Throws Error{Machine}: no GL.
Table2013 table2013(int width, int height, std::uint32_t k, int frames, double budgetMs = std::numeric_limits<double>::infinity());

std::string legendOf(const Table2013& table);
std::string toText(const Table2013& table);
std::string toMarkdown(const Table2013& table);
std::string htmlOf(const Table2013& table);   // its legend and a table

}  // namespace copeel::bench
