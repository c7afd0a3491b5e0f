// 224 random CSG scenes on a coarse grid, where coincident faces are the rule, at 0 wrong off-edge pixels.
#include <gtest/gtest.h>

#include "scene_sweep.h"

namespace copeel::validation {
namespace {

// Each part is 14 solids in four placements, so that parts run side by side.
class RandomScenes : public testing::TestWithParam<int> {};
TEST_P(RandomScenes, Off_edge_pixels_are_those_of_the_exact_solid) { sweepScenes(1 + 1000 * GetParam(), 14, 8, 96, 72); }
INSTANTIATE_TEST_SUITE_P(Part, RandomScenes, testing::Range(0, 4));

}  // namespace
}  // namespace copeel::validation
