// The wide sweep of random scenes, for the slow suite. COPEEL_SCENES=first,count says which seeds and how many solids.
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "scene_sweep.h"

namespace copeel::validation {
namespace {

TEST(RandomSweep, Off_edge_pixels_are_those_of_the_exact_solid) {
  int first = 100000, count = 120;
  if (const char* text = std::getenv("COPEEL_SCENES")) std::sscanf(text, "%d,%d", &first, &count);
  sweepScenes(std::uint64_t(first), count, 10, 160, 120);
}

}  // namespace
}  // namespace copeel::validation
