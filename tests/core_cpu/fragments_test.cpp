// Pixels of very many fragments: none is lost, whatever a tile must do to hold them.
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/stacks.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

View above(int size, double pixel = 0.01) { return lookAt({0.31, 0.33, 50}, {0.31, 0.33, 0}, size, size, pixel, false); }

struct Prepared {
  explicit Prepared(const Mesh& mesh, View v, double tolerance = 0) : scene({{share(mesh)}}), planes(scene, tolerance), view(v), frame(scene, planes, view) {}
  Scene scene;
  PlaneClasses planes;
  View view;
  cpu::Frame frame;
};

// `count` triangles over one another, in layers `gap` apart.
Mesh pile(unsigned count, double gap) {
  Mesh mesh;
  for (unsigned i = 0; i < count; ++i) {
    const double z = i * gap;
    mesh.vertices.insert(mesh.vertices.end(), {{-1, -1, z}, {3, -1, z}, {-1, 3, z}});
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

void expectSame(const Stacks& a, const Stacks& b) {
  ASSERT_EQ(a.pixels.size(), b.pixels.size());
  for (std::size_t i = 0; i < a.pixels.size(); ++i) ASSERT_EQ(a.pixels[i], b.pixels[i]) << "pixel " << i;
  for (std::size_t i = 0; i < b.ends.size(); ++i) ASSERT_EQ(b.ends[i], b.pixels[i].empty() ? 0 : 1);
}

TEST(Fragments, tenThousandLayersInOnePixelKeepTheirOrder) {
  const unsigned count = 10000;
  const Prepared p(pile(count, 1e-3), above(1));
  const Stacks stacks = stacksOf(p.frame);
  ASSERT_EQ(stacks.at(0, 0).size(), count);
  for (unsigned i = 0; i < count; ++i) ASSERT_EQ(stacks.at(0, 0)[i][0].primitive, count - 1 - i);
  EXPECT_EQ(stacks.counts.depthComplexityMax, count);
}

// Sixteen layers are sorted in registers and merged by steps from a table, up to 64; beyond, steps are found one by one.
TEST(Fragments, anyNumberOfLayersIsSortedOnAnySimdTarget) {
  std::vector<unsigned> counts(41);
  std::iota(counts.begin(), counts.end(), 0u);
  counts.insert(counts.end(), {63, 64, 65, 71, 129});
  for (const unsigned count : counts) {
    std::vector<unsigned> heights(count);
    std::iota(heights.begin(), heights.end(), 0u);
    std::shuffle(heights.begin(), heights.end(), std::mt19937(count));
    Mesh mesh = pile(count, 0);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) mesh.vertices[v].z = heights[v / 3] * 0.01;
    const Prepared p(mesh, above(9));
    for (const char* target : {"scalar", "sse4", "avx2", "best"}) {
      cpu::chooseSimd(target);
      const Stacks stacks = stacksOf(p.frame);
      for (const auto& pixel : stacks.pixels) {
        ASSERT_EQ(pixel.size(), count) << target;
        for (unsigned i = 0; i < count; ++i) ASSERT_EQ(heights[pixel[i][0].primitive], count - 1 - i) << target;
      }
    }
    cpu::chooseSimd("best");
  }
}

// A mesh placed again where the object before has it shares that one's vertices, references and list of classes.
TEST(Fragments, aMeshPlacedAgainIsMetAsACopyOfItIs) {
  const MeshPointer ball = share(sphere(0.4, 30, 20)), ground = share(quad({-50, -50, -0.3}, {50, -50, -0.3}, {50, 50, -0.3}, {-50, 50, -0.3}));
  const MeshPointer none = share(Mesh{});
  glm::dmat4 mirrored(1.0), aside(1.0);
  mirrored[0][0] = -1;
  aside[3] = {0.1, 0.2, 0.1, 1};
  const std::vector<Object> again = {{ball}, {ball}, {ball, mirrored}, {ball, mirrored}, {none}, {none}, {ground}, {ground}, {ground}, {ball}, {ball, aside}, {ball, aside}};
  std::vector<Object> copied = again;
  for (Object& object : copied) object.mesh = share(*object.mesh);
  const Scene scenes[] = {Scene(again), Scene(copied)};
  ASSERT_TRUE(scenes[0].repeats(1) && scenes[0].repeats(3) && scenes[0].repeats(8) && !scenes[1].repeats(1));
  // From outside, from among them, and close by: the ground is cut at the eye.
  for (const glm::dvec3& eye : {glm::dvec3(3, 1, 2), glm::dvec3(0.2, 0.1, 0.1), glm::dvec3(0.5, 0.5, -0.29)}) {
    const View view = lookAt(eye, {0, 0, 0}, 90, 70, 0.02);
    Stacks stacks[2];
    for (int i = 0; i < 2; ++i) {
      const PlaneClasses planes(scenes[i], 0);
      stacks[i] = stacksOf(cpu::Frame(scenes[i], planes, view));
    }
    expectSame(stacks[1], stacks[0]);
    EXPECT_GT(stacks[0].fragments(), 5000u);
    EXPECT_EQ(stacks[0].counts.fragments, stacks[1].counts.fragments);
  }
}

TEST(Fragments, coplanarOnesInOnePixelAreOneGroup) {
  for (const unsigned count : {1u, 2u, 255u, 256u, 257u, 65537u}) {
    const Prepared p(pile(count, 0), above(1));
    ASSERT_EQ(p.planes.classes().size(), 1u);
    const Stacks stacks = stacksOf(p.frame);
    ASSERT_EQ(stacks.at(0, 0).size(), 1u);
    const Group& group = stacks.at(0, 0)[0];
    ASSERT_EQ(group.size(), count);
    for (unsigned i = 0; i < count; ++i) ASSERT_EQ(group[i].primitive, i);
    EXPECT_EQ(stacks.counts.walk.coplanarPixels, count > 1);
  }
}

TEST(Fragments, aTileThatOverflowsItsBudgetIsSplitAndLosesNothing) {
  for (const Mesh& mesh : {pile(100, 0.1), sphere(0.4, 90, 60), joined(pile(300, 0), sphere(0.4, 40, 40))}) {
    const Prepared p(mesh, above(50, 0.02));
    const Stacks whole = stacksOf(p.frame);
    for (const std::size_t budget : {std::size_t{1}, std::size_t{20000}, std::size_t{300000}}) {
      cpu::TileOptions tiny;
      tiny.gridBudgetBytes = budget;
      expectSame(whole, stacksOf(p.frame, tiny));
    }
  }
}

// Inside large faces a pixel stands for its block (even_block.h), which no exact decision allows.
TEST(Fragments, blocksOfLargeFacesAreAsTheirPixels) {
  const Mesh crossing = joined(quad({-1, -1, -0.3}, {2, -1, 0.4}, {2, 2, 0.4}, {-1, 2, -0.3}), quad({-1, -1, 0.2}, {2, -1, 0.2}, {2, 2, -0.1}, {-1, 2, -0.1}));
  for (const Mesh& mesh : {pile(3, 0.1), pile(5, 0), crossing, joined(crossing, pile(2, 0)), joined(crossing, crossing), box({0, 0, 0}, {0.4, 0.5, 0.1})}) {
    for (const int size : {16, 37, 90}) {
      const Prepared p(mesh, above(size));
      cpu::TileOptions exactly;
      exactly.decideAllExactly = true;
      const Stacks blocks = stacksOf(p.frame), pixels = stacksOf(p.frame, exactly);
      expectSame(pixels, blocks);
      EXPECT_EQ(blocks.counts.fragments, pixels.counts.fragments);
      EXPECT_EQ(blocks.counts.captured, pixels.counts.captured);
      EXPECT_EQ(blocks.counts.coveredPixels, pixels.counts.coveredPixels);
      EXPECT_EQ(blocks.counts.depthComplexityMax, pixels.counts.depthComplexityMax);
      EXPECT_EQ(blocks.counts.walk.coplanarPixels, pixels.counts.walk.coplanarPixels);
    }
  }
}

// Few groups are wanted, so that tiles of many triangles are met in batches; a budget splits them after a batch or two.
TEST(Fragments, batchesAndSplitsGiveWhatOneBatchGives) {
  for (const Mesh& mesh : {pile(1000, 1e-3), joined(pile(500, 0), pile(500, -1e-4)), sphere(0.4, 100, 70)}) {
    const Prepared p(mesh, above(33, 0.02));
    Stacks all = stacksOf(p.frame);
    for (const std::size_t wanted : {std::size_t{1}, std::size_t{3}, std::size_t{40}}) {
      Stacks some = all;
      for (auto& pixel : some.pixels) pixel.resize(std::min(pixel.size(), wanted));
      for (const std::size_t budget : {std::size_t{16} << 20, std::size_t{60000}, std::size_t{400000}}) {
        cpu::TileOptions options;
        options.gridBudgetBytes = budget;
        expectSame(some, stacksOf(p.frame, options, {wanted}));
      }
    }
  }
}

// Regression: pixels finished in an early batch were finished again when a later batch split the tile, and samples then counted twice.
TEST(Fragments, aPixelIsFinishedOnceThoughALaterBatchSplitsItsTile) {
  // The left half of the tile ends at once; behind the right half lies more than the grid takes.
  const unsigned count = 1000;
  const Mesh mesh = joined(pile(count, 1e-3), quad({-5, -5, 20}, {0.31, -5, 20}, {0.31, 5, 20}, {-5, 5, 20}));
  const Prepared p(mesh, above(32, 0.02));
  for (const std::size_t budget : {std::size_t{20000}, std::size_t{200000}, std::size_t{2000000}, std::size_t{16000000}}) {
    cpu::TileOptions options;
    options.gridBudgetBytes = budget;
    const Stacks stacks = stacksOf(p.frame, options, {~std::size_t{0}, count});
    EXPECT_EQ(stacks.at(3, 9).size(), 1u);
    EXPECT_EQ(stacks.at(28, 9).size(), count);
    for (int n : stacks.ends) ASSERT_EQ(n, 1) << "budget " << budget;
  }
}

TEST(FragmentGrid, pixelsAreCountedAlikeOnAnySimdTarget) {
  std::mt19937 random(1);
  for (const std::size_t blocks : {std::size_t{1}, std::size_t{5}, std::size_t{16}}) {
    std::vector<std::uint32_t> counts(blocks * cpu::kBlockPixels);
    for (std::uint32_t& count : counts) count = static_cast<std::uint32_t>(random() % 3 ? random() % 9 : 0);
    counts[blocks * 7] = 30000000;
    for (const std::uint32_t nearest : {1u, 4u, cpu::kAllFragments}) {
      cpu::PixelCounts expected;
      for (const std::uint32_t n : counts) {
        expected.fragments += n, expected.captured += std::min(n, nearest), expected.covered += n > 0;
        expected.most = std::max(expected.most, n);
      }
      for (const char* target : {"scalar", "sse4", "avx2", "best"}) {
        cpu::chooseSimd(target);
        const cpu::PixelCounts found = cpu::countPixels(counts, nearest);
        EXPECT_EQ(found.fragments, expected.fragments) << target;
        EXPECT_EQ(found.captured, expected.captured) << target;
        EXPECT_EQ(found.covered, expected.covered) << target;
        EXPECT_EQ(found.most, expected.most) << target;
      }
      cpu::chooseSimd("best");
    }
  }
}

// How many layers a grid takes.
std::uint32_t layersOf(cpu::FragmentGrid& grid, const cpu::BlockRect& rect, std::uint32_t enough) {
  grid.begin(rect);
  std::uint32_t used = 0;
  while (used < enough) {
    const auto left = static_cast<std::uint32_t>(grid.room(used).left);
    if (left == 0) break;
    used += left;
  }
  return used;
}

TEST(FragmentGrid, aTileUsesItsBudgetToTheLastLayerAndABlockMayExceedIt) {
  constexpr cpu::BlockRect kTile, kBlock{2, 1, 3, 2};
  constexpr std::size_t kBudget = std::size_t{16} << 20, kLayerBytes = cpu::kBlocksPerTile * cpu::kBlockPixels * sizeof(std::uint64_t);
  cpu::FragmentGrid grid(kBudget);
  const std::uint32_t most = layersOf(grid, kTile, 100000);
  EXPECT_LE(most * kLayerBytes, kBudget);
  EXPECT_GT(most * kLayerBytes, kBudget * 49 / 50);
  EXPECT_GE(layersOf(grid, kBlock, 100000), 100000u);
  // What the block took is given back.
  EXPECT_EQ(layersOf(grid, kTile, 100000), most);
}

}  // namespace
}  // namespace copeel::test
