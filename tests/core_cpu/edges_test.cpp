// Batches of triangles set up for a tile: whatever the SIMD target and however full the batch, their bounds and edges hold the right samples.
#include <bit>
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

constexpr DepthPlane kNoPlane{};
constexpr cpu::TileFrame kTile{96, 32, 29, 17, 12, &kNoPlane, 5.5, -2.5};   // at the lower right of an image: not whole

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
    const auto number = static_cast<std::uint32_t>(i);
    batch.primitive[i] = 1000 + number, batch.object[i] = number / 3, batch.turn[i] = i % 2 ? -1 : 1;
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
bool isCovered(const cpu::TriangleSetup& t, int x, int y) {
  const int column = x - t.x0, row = y - t.y0;
  return column >= 0 && column < 4 && row >= 0 && row < 4 && (t.covered() >> (4 * row + column) & 1);
}

// The bounds, flags and slot of the batch's triangle are the setup's; slots are those of the batch, with the side that its object turns.
void expectSetup(const cpu::EdgeBatch& batch, int i) {
  const cpu::TriangleSetup& t = batch.setups[i];
  const bool isKept = batch.side[i] != 0, isSmall = isKept && batch.x1[i] - batch.x0[i] < 4 && batch.y1[i] - batch.y0[i] < 4;
  ASSERT_EQ(batch.isKept[i], isKept);
  ASSERT_EQ(batch.isSmall[i], isSmall);
  ASSERT_EQ(batch.withEdges >> i & 1, isKept && !isSmall);
  if (!isKept) return;
  ASSERT_EQ(glm::ivec4(t.x0, t.y0, t.x1, t.y1), glm::ivec4(batch.x0[i], batch.y0[i], batch.x1[i], batch.y1[i]));
  ASSERT_EQ(t.hasEdges(), !isSmall);
  if (isSmall) {
    ASSERT_EQ(t.place(), cpu::placeOf(t.x0, t.y0));
    ASSERT_EQ(std::popcount(t.covered()), batch.samples[i]);
  }
  const cpu::TileSlot& slot = batch.slots[i];
  ASSERT_EQ(slot.primitive, batch.primitive[i]);
  ASSERT_EQ(slot.object, batch.object[i]);
  ASSERT_EQ(slot.planeClass, batch.planeClass[i]);
  ASSERT_EQ(t.planeClass, batch.planeClass[i]);
  ASSERT_EQ(slot.side, batch.side[i] * batch.turn[i]);
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
        expectSetup(batch, i);
        known += batch.isSmall[i];
        for (int y = 0; y < kTile.height; ++y) {
          for (int x = 0; x < kTile.width; ++x) {
            const bool expected = covers(triangles[i].corner, std::int64_t{kTile.x0 + x} << 12, std::int64_t{kTile.y0 + y} << 12);
            ASSERT_EQ(holds(batch, i, x, y), expected) << "size " << size << ", triangle " << i << " of " << count << " at " << x << ", " << y;
            if (batch.isSmall[i]) { ASSERT_EQ(isCovered(batch.setups[i], x, y), expected) << "size " << size << ", triangle " << i; }
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

// orderAt, unclamped, of every sample of the triangle's bounds.
void addOrders(const cpu::EdgeBatch& batch, int i, const DepthPlane& plane, double& least, double& most) {
  for (int y = batch.y0[i]; y <= batch.y1[i]; ++y) {
    for (int x = batch.x0[i]; x <= batch.x1[i]; ++x) {
      const double order = plane.a * (kTile.u + x) + (plane.b * (kTile.v + y) + plane.c);
      least = std::min(least, order), most = std::max(most, order);
    }
  }
}

// What places hold beyond the last triangle, or of triangles that cover nothing, does not count. Equal to the bit: a sample beyond would have no key.
TEST_P(Edges, theExtentIsThatOfTheSamplesOfTrianglesThatAreSetUp) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> slope(-1, 1);
  for (int count = 1; count <= cpu::kEdgeBatch; ++count) {
    cpu::EdgeBatch batch = setUp(randomTriangles(cpu::kEdgeBatch, 3.0, static_cast<unsigned>(count)));
    std::vector<DepthPlane> planes;
    for (std::uint32_t i = 0; i < cpu::kEdgeBatch; ++i) {
      batch.planeClass[i] = i;
      // Low bits as errors have them, of 2^(16·a + b - 180).
      const float lo = std::bit_cast<float>(std::bit_cast<std::uint32_t>(-100.0f) | (10 + i % 2)), hi = std::bit_cast<float>(std::bit_cast<std::uint32_t>(100.0f) | i % 16);
      planes.push_back({slope(random), slope(random), slope(random), lo, hi});
      EXPECT_EQ(planes.back().error(), std::ldexp(1.0, static_cast<int>(16 * (10 + i % 2) + i % 16) - 180));
    }
    cpu::TileFrame tile = kTile;
    tile.planes = planes.data();
    cpu::DepthExtent expected = batch.extent = {};
    for (const int some : {count, cpu::kEdgeBatch - count}) {
      cpu::setUpEdges(batch, some, tile);
      for (int i = 0; i < some; ++i) {
        if (batch.side[i] == 0) continue;
        double least = INFINITY, most = -INFINITY;
        addOrders(batch, i, planes[static_cast<std::size_t>(i)], least, most);
        expected.add(least, most, planes[static_cast<std::size_t>(i)].error(), batch.samples[i]);
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
