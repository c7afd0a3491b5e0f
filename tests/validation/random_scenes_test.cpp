// 224 random CSG scenes on a coarse grid, where coincident faces are the rule, at 0 wrong off-edge pixels.
#include <array>
#include <cstdio>

#include <gtest/gtest.h>

#include "scene_sweep.h"
#include "validation/judge.h"
#include "validation/random_scene.h"

namespace copeel::validation {
namespace {

// Each part is 14 solids in four placements, so that parts run side by side.
class RandomScenes : public testing::TestWithParam<int> {};
TEST_P(RandomScenes, Off_edge_pixels_are_those_of_the_exact_solid) { sweepScenes(1 + 1000 * GetParam(), 14, 8, 96, 72); }
INSTANTIATE_TEST_SUITE_P(Part, RandomScenes, testing::Range(0, 4));

// What no exact kernel takes is judged by the exact crossings alone.
TEST(RandomScenes, Crossing_and_open_polyhedra_by_every_inside_rule) {
  Comparison sum;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const RandomScene scene = randomCrossingScene(seed);
    const Placement placement = kPlacements[seed % 4];
    const csg::Model model = modelOf(scene.text(placement));
    csg::RenderOptions options;
    options.inside = std::array{csg::InsideRule::NonZero, csg::InsideRule::Positive, csg::InsideRule::Odd}[seed % 3];
    for (int number = 0; const View& view : scene.views(placement, 96, 72)) {
      const Comparison c = judgeByRays(model, view, options);
      EXPECT_EQ(c.wrongOffEdge + c.wrongLeafOffEdge, 0u) << "seed " << seed << ", " << nameOf(placement) << ", view " << number << ": " << c.summary();
      sum.add(c);
      ++number;
    }
  }
  std::printf("%s\n", sum.summary().c_str());
  EXPECT_GT(sum.covered, 50000u);
  EXPECT_LE(sum.wrongEdge, 0.005 * sum.touched);
}

}  // namespace
}  // namespace copeel::validation
