// Polygons are cut without gain or loss: the triangles cover the polygon once, keep its orientation, and share a facet when it is flat.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

#include "core/formats/polygon.h"
#include "mesh_texts.h"

namespace copeel {
namespace {

using Points = std::vector<glm::dvec3>;

double areaAlong(const glm::dvec3& normal, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  return glm::dot(normal, glm::cross(b - a, c - a)) / 2;
}

// Every triangle counter-clockwise, all together the polygon's area: then they overlap nowhere.
void expectCover(const Points& points, const glm::dvec3& normal, double area) {
  PolygonCutter cutter;
  EXPECT_EQ(cutter.cut(points, false), PolygonCutter::Result::Planar);
  ASSERT_EQ(cutter.triangles().size(), points.size() - 2);
  double sum = 0;
  for (const glm::uvec3& t : cutter.triangles()) {
    const double part = areaAlong(normal, points[t.x], points[t.y], points[t.z]);
    EXPECT_GE(part, -1e-14 * area);
    sum += part;
  }
  EXPECT_NEAR(sum, area, 1e-12 * area);
}

TEST(Polygon, nonConvexInEveryPlaneAndBothOrientations) {
  // An L, of area 3.
  const Points flat = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}};
  for (std::size_t start = 0; start < flat.size(); ++start) {
    Points xy, yz, zx, down;
    for (std::size_t i = 0; i < flat.size(); ++i) {
      const glm::dvec3 p = flat[(start + i) % flat.size()], q = flat[(start + flat.size() - i) % flat.size()];
      xy.push_back(p);
      yz.emplace_back(7, p.x, p.y);
      zx.emplace_back(p.y, -3, p.x);
      down.push_back(q);
    }
    expectCover(xy, {0, 0, 1}, 3);
    expectCover(yz, {1, 0, 0}, 3);
    expectCover(zx, {0, 1, 0}, 3);
    expectCover(down, {0, 0, -1}, 3);
  }
}

TEST(Polygon, combsSpiralsCollinearCornersAndKeyholes) {
  Points comb = {{0, 0, 0}, {100, 0, 0}};
  for (int i = 99; i >= 0; --i) comb.emplace_back(i + 0.5, i % 2 ? 1 : 100, 0);
  double area = 0;
  for (std::size_t i = 1; i + 1 < comb.size(); ++i) area += areaAlong({0, 0, 1}, comb[0], comb[i], comb[i + 1]);
  expectCover(comb, {0, 0, 1}, area);
  expectCover({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}}, {0, 0, 1}, 4);
  // A square with a square hole, joined by a cut that runs there and back.
  expectCover(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0}, {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}},
      {0, 0, 1}, 12);
}

TEST(Polygon, extremeCoordinates) {
  for (const double scale : {1e-300, 1e-150, 1e150, 1e307}) {
    PolygonCutter cutter;
    const Points points = {{0, 0, 0},         {2 * scale, 0, 0},     {2 * scale, scale, 0},
                           {scale, scale, 0}, {scale, 2 * scale, 0}, {0, 2 * scale, 0}};
    EXPECT_EQ(cutter.cut(points, false), PolygonCutter::Result::Planar) << scale;
    EXPECT_EQ(cutter.triangles().size(), 4u);
  }
}

TEST(Polygon, withoutAreaOrCrossingItselfNothingIsLost) {
  PolygonCutter cutter;
  cutter.cut(Points(5, glm::dvec3(1, 2, 3)), false);
  EXPECT_EQ(cutter.triangles().size(), 3u);
  cutter.cut(Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, false);
  EXPECT_EQ(cutter.triangles().size(), 2u);
  cutter.cut(Points{{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 3, 0}}, false);
  EXPECT_EQ(cutter.triangles().size(), 2u);
}

TEST(Polygon, facetsAreSharedOnlyWhereFlat) {
  const std::string cubeAndTriangle =
      "OFF 6 4 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 1 1\n3 0 1 4\n4 0 1 2 3\n3 0 1 5\n";
  const Mesh flat = meshOf(cubeAndTriangle + "4 0 1 5 4\n");
  EXPECT_EQ(flat.facets, (std::vector<std::uint32_t>{0, 1, 1, 2, 3, 4}));
  EXPECT_EQ(flat.facetCount(), 5u);
  const Mesh triangles = meshOf("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  EXPECT_TRUE(triangles.facets.empty());
}

TEST(Polygon, roundingToTheFilesPrecisionStaysFlat) {
  // An oblique square, its corners rounded to float: flat for a float file, a film of 1e-8 for a double file.
  Points square;
  for (const glm::dvec2 p : {glm::dvec2(0, 0), glm::dvec2(1, 0), glm::dvec2(1, 1), glm::dvec2(0, 1)}) {
    const glm::dvec3 exact =
        glm::dvec3(0.3, 0.2, 0.7) + p.x * glm::dvec3(0.61, 0.33, 0.1) + p.y * glm::dvec3(-0.2, 0.47, 0.83);
    square.emplace_back(double{float(exact.x)}, double{float(exact.y)}, double{float(exact.z)});
  }
  PolygonCutter cutter;
  EXPECT_EQ(cutter.cut(square, true), PolygonCutter::Result::Planar);
  EXPECT_EQ(cutter.cut(square, false), PolygonCutter::Result::NotPlanar);
}

// Polygons that are star-shaped about the origin do not cross themselves, however their radii jump.
RC_GTEST_PROP(PolygonProperty, starsAreCovered, ()) {
  const auto radii = *rc::gen::container<std::vector<int>>(*rc::gen::inRange(3, 60), rc::gen::inRange(1, 100));
  Points points;
  double area = 0;
  const double step = 2 * std::numbers::pi / double(radii.size());
  for (std::size_t i = 0; i < radii.size(); ++i) {
    points.emplace_back(radii[i] * std::cos(step * double(i)), radii[i] * std::sin(step * double(i)), 0.0);
    area += radii[i] * radii[(i + 1) % radii.size()] * std::sin(step) / 2;
  }
  PolygonCutter cutter;
  RC_ASSERT(cutter.cut(points, false) == PolygonCutter::Result::Planar);
  RC_ASSERT(cutter.triangles().size() == points.size() - 2);
  double sum = 0;
  for (const glm::uvec3& t : cutter.triangles())
    sum += std::abs(areaAlong({0, 0, 1}, points[t.x], points[t.y], points[t.z]));
  RC_ASSERT(std::abs(sum - area) < 1e-9 * area);
}

TEST(Polygon, manyCornersTakeNoLongerThanTheyMust) {
  Points circle;
  for (int i = 0; i < 100000; ++i) circle.emplace_back(std::cos(i * 6.283e-5), std::sin(i * 6.283e-5), 0.0);
  PolygonCutter cutter;
  EXPECT_EQ(cutter.cut(circle, false), PolygonCutter::Result::Planar);
}

}  // namespace
}  // namespace copeel
