// Every example against the exact crossings from two sides, and the small ones against an exact Boolean by CGAL. Skipped where openscad is missing.
#include <algorithm>
#include <cstdio>
#include <filesystem>

#include <gtest/gtest.h>

#include "apps/csg/read_model.h"
#include "core/scene/camera.h"
#include "validation/exact_boolean.h"
#include "validation/judge.h"
#include "validation/openscad_adapter.h"

namespace copeel::validation {
namespace {

constexpr std::size_t kExactTriangleCount = 3000;   // of all leaves together: some seconds of Nef polyhedra
constexpr double kEdgeShare = 0.005;

std::vector<std::string> examples() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(COPEEL_EXAMPLES))
    if (entry.path().extension() == ".scad") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class Examples : public testing::TestWithParam<std::string> {};

TEST_P(Examples, Depth_is_exact_off_edges) {
  if (!openscadIsHere()) GTEST_SKIP() << "openscad is not installed";
  const csg::Model model = csg::readScad(std::string(COPEEL_EXAMPLES) + "/" + GetParam() + ".scad", {});
  std::size_t triangles = 0;
  for (const csg::Leaf& leaf : model.leaves) triangles += leaf.mesh->triangles.size();
  const std::optional<OracleMesh> truth = triangles <= kExactTriangleCount ? exactBoolean(model) : std::nullopt;

  // As the program shows it without options, and from below.
  csg::Renderer renderer(model, {});
  const auto expectRight = [](const Comparison& c, const char* against) {
    EXPECT_EQ(c.wrongOffEdge + c.wrongLeafOffEdge, 0u) << against << ": " << c.summary();
    EXPECT_LE(c.wrongEdge, kEdgeShare * c.touched) << against << ": " << c.summary();
    EXPECT_GT(c.covered, c.pixels / 20);
  };
  for (const std::vector<double>& camera : {std::vector<double>{}, {0, 0, 0, 140, 0, 35, 100}}) {
    const View view = viewOf({camera, true, true, true, 320, 240}, renderer.bounds());
    expectRight(judgeByRays(model, view), "exact crossings");
    if (truth) expectRight(judgeByMesh(model, *truth, view), "CGAL");
  }
  std::printf("%zu leaves, %zu triangles%s\n", model.leaves.size(), triangles, truth ? ", also against CGAL" : "");
}

INSTANTIATE_TEST_SUITE_P(All, Examples, testing::ValuesIn(examples()), [](const auto& example) { return example.param; });

}  // namespace
}  // namespace copeel::validation
