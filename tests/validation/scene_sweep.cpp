#include "scene_sweep.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "validation/exact_boolean.h"
#include "validation/judge.h"
#include "validation/random_scene.h"

namespace copeel::validation {
namespace {

constexpr double kEdgeShare = 0.005;             // of the touched pixels may be wrong on edges

struct Sweep {
  Comparison byMesh, byRays, oracles;
  int scenes = 0, withMesh = 0;
};

void judgeScene(const RandomScene& scene, Placement placement, const std::optional<OracleMesh>& exact, int width, int height, Sweep& sweep) {
  const csg::Model model = modelOf(scene.text(placement));
  std::optional<OracleMesh> truth;
  if (exact) truth = transformedExactly(*exact, scene.motion(placement));
  ++sweep.scenes;
  sweep.withMesh += truth.has_value();
  int number = 0;
  for (const View& view : scene.views(placement, width, height)) {
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

}  // namespace

void sweepScenes(std::uint64_t first, int count, int maxLeafCount, int width, int height) {
  Sweep sweep;
  // Trees whose solid is empty show nothing and are not counted.
  for (std::uint64_t seed = first; sweep.scenes < 4 * count; ++seed) {
    const RandomScene scene = randomScene(seed, maxLeafCount);
    const std::optional<OracleMesh> exact = exactBoolean(modelOf(scene.text(Placement::Plain)));
    if (exact && exact->triangles.empty()) continue;
    for (const Placement placement : kPlacements) judgeScene(scene, placement, exact, width, height, sweep);
  }
  std::printf("%d scenes, %d of them against CGAL\n  against CGAL: %s\n  against exact crossings: %s\n  the two: %s\n", sweep.scenes, sweep.withMesh,
              sweep.byMesh.summary().c_str(), sweep.byRays.summary().c_str(), sweep.oracles.summary().c_str());
  EXPECT_GT(sweep.withMesh, sweep.scenes / 2);
  EXPECT_LE(sweep.byMesh.wrongEdge, kEdgeShare * sweep.byMesh.touched);
  EXPECT_LE(sweep.byRays.wrongEdge, kEdgeShare * sweep.byRays.touched);
}

}  // namespace copeel::validation
