// Batches of triangles set up for a tile: whatever the SIMD target and however full the batch, their bounds and edges hold the right samples.
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/cpu/edges.h"
#include "core/cpu/kernels.h"
#include "tests/support/samples.h"

namespace copeel::test {
namespace {

constexpr cpu::TileFrame kTile{96, 32, 29, 17, 12};   // at the lower right of an image: not whole

struct Triangle {
  glm::ivec2 corner[3];
};

std::vector<Triangle> randomTriangles(int count, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> across(-2, 31), down(-2, 19), by(-size, size);
  std::vector<Triangle> triangles;
  for (int i = 0; i < count; ++i) {
    const glm::dvec2 center(kTile.x0 + across(random), kTile.y0 + down(random));
    Triangle t;
    for (glm::ivec2& c : t.corner) {
      c = glm::ivec2(std::lrint((center.x + by(random)) * 4096), std::lrint((center.y + by(random)) * 4096));
      // Every third has its corners on samples; every fifth is a line; some are points.
      if (i % 3 == 0) c = {c.x & ~4095, c.y & ~4095};
    }
    if (i % 5 == 0) t.corner[2] = t.corner[0];
    if (i % 35 == 0) t.corner[1] = t.corner[0];
    triangles.push_back(t);
  }
  return triangles;
}

cpu::EdgeBatch setUp(const std::vector<Triangle>& triangles) {
  cpu::EdgeBatch batch;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const auto& c = triangles[i].corner;
    batch.p[i] = c[0], batch.q[i] = c[1], batch.r[i] = c[2];
  }
  cpu::setUpEdges(batch, static_cast<int>(triangles.size()), kTile);
  return batch;
}

bool holds(const cpu::EdgeBatch& batch, int i, int x, int y) {
  if (batch.side[i] == 0 || x < batch.x0[i] || x > batch.x1[i] || y < batch.y0[i] || y > batch.y1[i]) return false;
  for (int k = 0; k < 3; ++k) {
    if (batch.a[k][i] * x + batch.b[k][i] * y + batch.c[k][i] < 0) return false;
  }
  return true;
}

// As the bits tell of a small triangle.
bool isCovered(const cpu::EdgeBatch& batch, int i, int x, int y) {
  const int column = x - batch.x0[i], row = y - batch.y0[i];
  return column >= 0 && column < 4 && row >= 0 && row < 4 && (batch.covered[i] >> (8 * row + column) & 1);
}

class Edges : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { cpu::chooseSimd(GetParam()); }
  void TearDown() override { cpu::chooseSimd("best"); }
};

TEST_P(Edges, holdTheSamplesOfTheirTriangles) {
  int covered = 0, none = 0, known = 0;
  for (const double size : {0.4, 1.2, 2.0, 3.0, 30.0, 1000.0}) {
    for (int count = 1; count <= cpu::kEdgeBatch; ++count) {
      const std::vector<Triangle> triangles = randomTriangles(count, size, static_cast<unsigned>(count));
      const cpu::EdgeBatch batch = setUp(triangles);
      for (int i = 0; i < count; ++i) {
        none += batch.side[i] == 0;
        known += batch.side[i] != 0 && batch.covered[i] != 0;
        for (int y = 0; y < kTile.height; ++y) {
          for (int x = 0; x < kTile.width; ++x) {
            const bool expected = covers(triangles[i].corner, std::int64_t{kTile.x0 + x} << 12, std::int64_t{kTile.y0 + y} << 12);
            ASSERT_EQ(holds(batch, i, x, y), expected) << "size " << size << ", triangle " << i << " of " << count << " at " << x << ", " << y;
            if (batch.side[i] != 0 && batch.covered[i] != 0) { ASSERT_EQ(isCovered(batch, i, x, y), expected) << "size " << size << ", triangle " << i; }
            covered += expected;
          }
        }
      }
    }
  }
  EXPECT_GT(covered, 50000);
  EXPECT_GT(none, 500);
  EXPECT_GT(known, 300);
}

// What places hold beyond the last triangle, or of triangles that cover nothing, does not count.
TEST_P(Edges, theExtentIsThatOfTheTrianglesThatAreSetUp) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> slope(-1, 1);
  for (int count = 1; count <= cpu::kEdgeBatch; ++count) {
    cpu::EdgeBatch batch = setUp(randomTriangles(cpu::kEdgeBatch, 3.0, static_cast<unsigned>(count)));
    for (int i = 0; i < cpu::kEdgeBatch; ++i) {
      batch.planeA[i] = slope(random), batch.planeB[i] = slope(random), batch.planeC[i] = slope(random);
      batch.planeLo[i] = -10, batch.planeHi[i] = 10, batch.planeError[i] = static_cast<float>(2 + slope(random));
    }
    cpu::DepthExtent expected = batch.extent = {};
    for (const int some : {count, cpu::kEdgeBatch - count}) {
      cpu::setUpEdges(batch, some, kTile);
      for (int i = 0; i < some; ++i) {
        if (batch.side[i] != 0) expected.add(batch.least[i], batch.most[i], batch.error[i], batch.samples[i]);
      }
    }
    EXPECT_EQ(batch.extent.least, expected.least);
    EXPECT_EQ(batch.extent.most, expected.most);
    EXPECT_EQ(batch.extent.leastError, expected.leastError);
    EXPECT_EQ(batch.extent.mostError, expected.mostError);
    EXPECT_EQ(batch.extent.samples, expected.samples);
  }
}

TEST_P(Edges, aDegenerateTriangleIsDroppedAndTheSideIsThatOfItsTurn) {
  const glm::ivec2 a(97 << 12, 33 << 12), b(110 << 12, 34 << 12), c(99 << 12, 45 << 12);
  const cpu::EdgeBatch batch = setUp({{{a, b, c}}, {{a, c, b}}, {{a, b, a}}, {{a, a, a}}, {{a, b, a + (b - a) * 3}}});
  EXPECT_EQ(batch.side[0], -1);
  EXPECT_EQ(batch.side[1], 1);
  for (int i = 2; i < 5; ++i) EXPECT_EQ(batch.side[i], 0);
  // The area between the sides (13, 1) and (2, 12), less than half of the bounds.
  EXPECT_EQ(batch.samples[0], (13 * 12 - 2 * 1) / 2);
  EXPECT_EQ(batch.samples[1], batch.samples[0]);
}

INSTANTIATE_TEST_SUITE_P(Targets, Edges, testing::Values("scalar", "sse4", "avx2", "best"));

}  // namespace
}  // namespace copeel::test
