// Random CSG scenes on a coarse grid: the renderer against exact Booleans by CGAL and against the oracle of exact crossings, which must agree with each other.
// The slow suite widens the sweep; the environment's COPEEL_SCENES (first seed, count of solids) says where.
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "validation/exact_boolean.h"
#include "validation/judge.h"
#include "validation/random_scene.h"

namespace copeel::validation {
namespace {

constexpr int kWidth = 96, kHeight = 72;         // pixels
constexpr double kEdgeShare = 0.005;             // of the touched pixels may be wrong on edges

struct Sweep {
  Comparison byMesh, byRays, oracles;
  int scenes = 0, withMesh = 0;
};

void judgeScene(const RandomScene& scene, Placement placement, const std::optional<OracleMesh>& exact, Sweep& sweep) {
  const csg::Model model = modelOf(scene.text(placement));
  std::optional<OracleMesh> truth;
  if (exact) truth = transformedExactly(*exact, scene.motion(placement));
  ++sweep.scenes;
  sweep.withMesh += truth.has_value();
  int number = 0;
  for (const View& view : scene.views(placement, kWidth, kHeight)) {
    const CsgOracle rays(model, view);
    csg::RenderOptions options;
    options.wantDepth = options.wantIds = true;
    options.threads = 1;
    const csg::Frame frame = csg::Renderer(model, options).draw(view);

    const auto note = [&](const char* what, const Comparison& c, Comparison& sum) {
      sum.add(c);
      if (c.wrongOffEdge + c.wrongLeafOffEdge > 0)
        ADD_FAILURE() << what << ": seed " << scene.seed << ", " << nameOf(placement) << ", view " << number << ": " << c.summary();
    };
    note("renderer against exact crossings", compareDepth(frame.depth, rays, rays.caster(), &frame.ids), sweep.byRays);
    if (truth) {
      const MeshOracle mesh(*truth, view, rays.diagonal());
      note("renderer against CGAL", compareDepth(frame.depth, mesh, rays.caster()), sweep.byMesh);
      note("exact crossings against CGAL", compareOracles(rays, mesh, rays.caster()), sweep.oracles);
    }
    ++number;
  }
}

void sweepScenes(std::uint64_t first, int count, int maxLeafCount) {
  Sweep sweep;
  // Trees whose solid is empty show nothing and are not counted.
  for (std::uint64_t seed = first; sweep.scenes < 4 * count; ++seed) {
    const RandomScene scene = randomScene(seed, maxLeafCount);
    const std::optional<OracleMesh> exact = exactBoolean(modelOf(scene.text(Placement::Plain)));
    if (exact && exact->triangles.empty()) continue;
    for (const Placement placement : kPlacements) judgeScene(scene, placement, exact, sweep);
  }
  std::printf("%d scenes, %d of them against CGAL\n  against CGAL: %s\n  against exact crossings: %s\n  the two: %s\n", sweep.scenes, sweep.withMesh,
              sweep.byMesh.summary().c_str(), sweep.byRays.summary().c_str(), sweep.oracles.summary().c_str());
  EXPECT_GT(sweep.withMesh, sweep.scenes / 2);
  EXPECT_LE(sweep.byMesh.wrongEdge, kEdgeShare * sweep.byMesh.touched);
  EXPECT_LE(sweep.byRays.wrongEdge, kEdgeShare * sweep.byRays.touched);
}

// Each case is 14 solids in four placements from three views; together 224 scenes.
class RandomScenes : public testing::TestWithParam<int> {};
TEST_P(RandomScenes, Off_edge_pixels_are_those_of_the_exact_solid) { sweepScenes(1 + 1000 * GetParam(), 14, 8); }
INSTANTIATE_TEST_SUITE_P(Part, RandomScenes, testing::Range(0, 4));

TEST(RandomScenesSweep, DISABLED_Of_the_environment) {
  const char* text = std::getenv("COPEEL_SCENES");
  int first = 1000, count = 20;
  if (text) std::sscanf(text, "%d,%d", &first, &count);
  sweepScenes(first, count, 8);
}

}  // namespace
}  // namespace copeel::validation
