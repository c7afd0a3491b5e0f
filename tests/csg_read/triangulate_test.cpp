// Triangles cover what the loops enclose, once, whatever touches whatever.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "apps/csg/orientation.h"
#include "apps/csg/triangulate.h"

namespace copeel::csg {
namespace {

struct Loops {
  std::vector<glm::dvec2> points;
  std::vector<std::uint32_t> ends;
  void add(const std::vector<glm::dvec2>& loop) {
    points.insert(points.end(), loop.begin(), loop.end());
    ends.push_back(static_cast<std::uint32_t>(points.size()));
  }
};

// Triangles are left turns; their areas add up.
void expectArea(const Loops& loops, double area) {
  const auto triangles = triangulate(loops.points, loops.ends);
  ASSERT_TRUE(triangles.has_value());
  double sum = 0;
  for (const glm::uvec3& t : *triangles) {
    const glm::dvec2 &a = loops.points[t.x], &b = loops.points[t.y], &c = loops.points[t.z];
    EXPECT_GT(orientation(a, b, c), 0);
    sum += ((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)) / 2;
  }
  EXPECT_NEAR(sum, area, 1e-9 * (1 + std::abs(area)));
}

double areaOf(const std::vector<glm::dvec2>& loop) {
  double area = 0;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const glm::dvec2 &a = loop[i], &b = loop[(i + 1) % loop.size()];
    area += (a.x * b.y - a.y * b.x) / 2;
  }
  return area;
}

std::vector<glm::dvec2> star(std::mt19937& random, glm::dvec2 center, double r, int n) {
  std::uniform_real_distribution<double> radius(0.2 * r, r);
  std::vector<glm::dvec2> loop;
  for (int i = 0; i < n; ++i) loop.push_back(center + radius(random) * glm::dvec2(std::cos(6.2831853 * i / n), std::sin(6.2831853 * i / n)));
  return loop;
}

TEST(Triangulate, starsWithHoles) {
  std::mt19937 random(1);
  for (int round = 0; round < 300; ++round) {
    Loops loops;
    const auto outer = star(random, {0, 0}, 10, 3 + static_cast<int>(random() % 200));
    const auto hole = star(random, {0, 0}, 1.2, 3 + static_cast<int>(random() % 40));
    loops.add(outer);
    loops.add(hole);
    expectArea(loops, areaOf(outer) - areaOf(hole));
  }
}

// Squares of a grid that share edges and corners: what an odd number of them covers.
TEST(Triangulate, loopsThatTouch) {
  std::mt19937 random(2);
  for (int round = 0; round < 200; ++round) {
    Loops loops;
    std::vector<int> cover(64, 0);
    for (int k = 0; k < 12; ++k) {
      const int x = static_cast<int>(random() % 8), y = static_cast<int>(random() % 8);
      ++cover[static_cast<std::size_t>(8 * y + x)];
      loops.add({{x, y}, {x + 1, y}, {x + 1, y + 1}, {x, y + 1}});
    }
    double area = 0;
    for (const int c : cover) area += c % 2;
    expectArea(loops, area);
  }
}

TEST(Triangulate, collinearCornersNeedlesAndRepeatedPoints) {
  Loops line;
  line.add({{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1e-9}, {0, 1e-9}, {0, 1e-9}});
  expectArea(line, 3e-9);
  Loops comb;
  std::vector<glm::dvec2> loop;
  for (int i = 0; i < 500; ++i) loop.insert(loop.end(), {{i, 0}, {i + 0.5, 100}});
  loop.insert(loop.end(), {{500, 0}, {500, -1e-6}, {0, -1e-6}});
  const double area = std::abs(areaOf(loop));
  comb.add(loop);
  expectArea(comb, area);
  Loops none;
  none.add({{0, 0}, {1, 1}, {2, 2}});
  expectArea(none, 0);
}

// A face of one place, and faces so far out that their extent is lost beside their coordinates.
TEST(Triangulate, facesWithoutAnExtent) {
  for (const std::vector<glm::dvec2>& corners : std::vector<std::vector<glm::dvec2>>{
           {{1, 1}, {1, 1}, {1, 1}, {1, 1}}, {{1, 1}, {2, 2}, {1, 1}}, {{0, 1e20}, {1, 1e20}, {2, 1e20}, {3, 1e20}},
           {{-1e30, 0}, {-1e30, 1e-100}, {-1e30, 2e-100}}}) {
    Loops loops;
    loops.add(corners);
    expectArea(loops, 0);
  }
}

TEST(Triangulate, whatNoFrameCanHoldIsRefused) {
  Loops loops;
  loops.add({{0, 0}, {1e308, 0}, {-1e308, 1e307}, {0, 1e308}});
  EXPECT_FALSE(triangulate(loops.points, loops.ends).has_value());
}

// On the line through a and b, up to the last bit of a coordinate of any size.
TEST(Triangulate, orientationIsExact) {
  const glm::dvec2 a(0.1, 0.1), b(1e17 + 16, 1e17 + 16);
  EXPECT_EQ(orientation(a, b, {3e-30, 3e-30}), 0);
  EXPECT_GT(orientation(a, b, {3e-30, std::nextafter(3e-30, 1)}), 0);
  EXPECT_LT(orientation(a, b, {3e-30, std::nextafter(3e-30, 0)}), 0);
}

TEST(Triangulate, loopsThatCrossAreRefused) {
  Loops bowTie;
  bowTie.add({{0, 0}, {2, 2}, {2, 0}, {0, 2}});
  EXPECT_FALSE(triangulate(bowTie.points, bowTie.ends).has_value());
}

TEST(Triangulate, aLargeCircleIsFast) {
  Loops circle;
  std::vector<glm::dvec2> loop;
  for (int i = 0; i < 20000; ++i) loop.emplace_back(std::cos(6.283185307179586 * i / 20000), std::sin(6.283185307179586 * i / 20000));
  circle.add(loop);
  expectArea(circle, areaOf(loop));
}

}  // namespace
}  // namespace copeel::csg
