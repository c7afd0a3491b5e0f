// What six digits took from a rotation is given back; what they did not take is not touched.
#include <random>

#include <fmt/format.h>
#include <glm/gtc/matrix_access.hpp>
#include <gtest/gtest.h>

#include "apps/csg/degrees.h"
#include "apps/csg/read_model.h"
#include "apps/csg/restore_matrix.h"
#include "core/scene/scene.h"
#include "tests/csg_read/openscad_peer.h"

namespace copeel::csg {
namespace {

using namespace test;

glm::dmat3 turn(double a, double b, double c) {
  const auto x = [](double t) { return glm::dmat3(1, 0, 0, 0, cosDegrees(t), sinDegrees(t), 0, -sinDegrees(t), cosDegrees(t)); };
  const auto y = [](double t) { return glm::dmat3(cosDegrees(t), 0, -sinDegrees(t), 0, 1, 0, sinDegrees(t), 0, cosDegrees(t)); };
  const auto z = [](double t) { return glm::dmat3(cosDegrees(t), sinDegrees(t), 0, -sinDegrees(t), cosDegrees(t), 0, 0, 0, 1); };
  return z(c) * y(b) * x(a);
}

double distance(const glm::dmat3& a, const glm::dmat3& b) {
  double largest = 0;
  for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(a[i / 3][i % 3] - b[i / 3][i % 3]));
  return largest;
}

glm::dmat3 throughSixDigits(glm::dmat3 m) {
  for (int i = 0; i < 9; ++i) m[i / 3][i % 3] = std::stod(fmt::format("{:g}", m[i / 3][i % 3]));
  return m;
}

TEST(RestoreMatrix, roundAnglesAndFractionsOfATurn) {
  std::mt19937 random(1);
  int restored = 0, total = 0;
  for (int i = 0; i < 3000; ++i) {
    const auto whole = [&] { return static_cast<double>(random() % 360); };
    const auto part = [&](unsigned most) {
      const int q = static_cast<int>(random() % most) + 1;
      return 360.0 * static_cast<int>(random() % static_cast<unsigned>(q)) / q;
    };
    // One axis: any part of a turn. Three axes: two of them whole degrees, one a part of a turn up to a sixtieth.
    const glm::dmat3 exact = i % 2 ? turn(0, 0, part(360)) : i % 4 ? turn(whole(), whole(), part(60)) : turn(part(60), whole(), whole());
    glm::dmat3 m = throughSixDigits(exact);
    restoreRotation(m);
    ++total;
    restored += distance(m, exact) < 1e-14;
  }
  // Near ±90° about y the other two angles are hardly told apart: rounder ones may give the same digits.
  EXPECT_GT(restored, total * 985 / 1000) << "of " << total;
}

TEST(RestoreMatrix, neverFartherAwayThanTheText) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> degrees(-180, 180);
  for (int i = 0; i < 2000; ++i) {
    const glm::dmat3 written = throughSixDigits(turn(degrees(random), degrees(random), degrees(random)));
    glm::dmat3 m = written;
    if (restoreRotation(m)) {
      EXPECT_LT(distance(m, written), 5.1e-7);
      EXPECT_LT(distance(glm::transpose(m) * m, glm::dmat3(1)), 1e-14);
    }
  }
}

TEST(RestoreMatrix, mirrorsScalesAndAxes) {
  const glm::dvec3 n = glm::normalize(glm::dvec3(1, 2, 3));
  const glm::dmat3 exact[] = {glm::dmat3(1) - 2.0 * glm::outerProduct(n, n), turn(10, 20, 30) * 2.5, turn(0, 0, 360.0 / 7) * 25.4};
  for (const glm::dmat3& e : exact) {
    glm::dmat3 m = throughSixDigits(e);
    EXPECT_TRUE(restoreRotation(m));
    EXPECT_LT(distance(m, e), 1e-13 * std::abs(glm::determinant(e)));
  }
}

TEST(RestoreMatrix, whatIsNoRotationOrWasGivenInFullStays) {
  const char* const texts[] = {"[[0.8660254, -0.5, 0, 0], [0.5, 0.8660254, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
                               "[[1, 0.3, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]",
                               "[[0.866025, -0.5, 0, 0], [0.5, 0.866, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]"};
  const double corner[] = {0.8660254, 1, 0.866025};
  for (int i = 0; i < 3; ++i) {
    const Model model = parseCsg(fmt::format("multmatrix({}) cube(1);", texts[i]), "a.csg", ".", ReadOptions{});
    EXPECT_EQ(model.leaves[0].worldFromObject[0].x, corner[i]);
  }
  const Model model = parseCsg("multmatrix([[0.866025, -0.5, 0, 7.1], [0.5, 0.866025, 0, 0], [0, 0, 1, 0]]) cube(1);", "a", ".", ReadOptions{});
  EXPECT_EQ(model.leaves[0].worldFromObject[0].x, cosDegrees(30));
  EXPECT_EQ(model.leaves[0].worldFromObject[3].x, 7.1);
}

// The greatest distance from a vertex of one leaf to the nearest vertex of the other, over vertices that should meet.
double gapBetween(const Leaf& a, const Leaf& b, std::size_t meeting) {
  std::vector<double> nearest;
  for (const glm::dvec3& p : a.mesh->vertices) {
    double least = 1e9;
    for (const glm::dvec3& q : b.mesh->vertices) {
      least = std::min(least, glm::length(transformPoint(a.worldFromObject, p) - transformPoint(b.worldFromObject, q)));
    }
    nearest.push_back(least);
  }
  std::sort(nearest.begin(), nearest.end());
  return nearest[meeting - 1];
}

TEST(RestoreMatrix, leavesTurnedOneByOneMeetAgain) {
  SKIP_WITHOUT_OPENSCAD();
  const auto read = [](const std::string& scad) { return parseCsg(csgBy(scad), "a.csg", ".", ReadOptions{}); };
  const Model cubes = read("rotate([10,20,30]) cube(10); rotate([10,20,30]) translate([10,0,0]) cube(10); rotate(30,[1,1,1]) cube(7);"
                           "rotate(30,[1,1,1]) translate([0,7,0]) cube(7);");
  EXPECT_LT(gapBetween(cubes.leaves[0], cubes.leaves[1], 4), 1e-12 * 10);
  EXPECT_LT(gapBetween(cubes.leaves[2], cubes.leaves[3], 4), 1e-12 * 10);
  // A prism turned by a step of its own symmetry lies where it lay.
  for (const int n : {6, 7, 9, 11}) {
    const Model prisms = read(fmt::format("for (i = [0 : {0} - 1]) rotate([10, 20, i * 360 / {0}]) rotate([0, 0, 5]) cylinder(r = 50, h = 5, $fn = {0});"
                                          "for (i = [0 : {0} - 1]) rotate([0, 0, i * 360 / {0}]) cylinder(r = 50, h = 5, $fn = {0});", n));
    for (int i = 1; i < n; ++i) {
      const auto at = static_cast<std::size_t>(n + i);
      EXPECT_LT(gapBetween(prisms.leaves[static_cast<std::size_t>(n)], prisms.leaves[at], static_cast<std::size_t>(2 * n)), 1e-12 * 50);
    }
  }
}

}  // namespace
}  // namespace copeel::csg
