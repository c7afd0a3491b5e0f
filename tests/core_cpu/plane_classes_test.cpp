// Which faces are of one plane.
#include <algorithm>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "core/coplanarity/plane_classes.h"
#include "tests/support/meshes.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

std::size_t classesOf(std::vector<Object> objects, double tolerance = 0) {
  const Scene scene(std::move(objects));
  return PlaneClasses(scene, tolerance).classes().size();
}
Object at(const Mesh& mesh, const glm::dmat4& m = glm::dmat4(1)) { return {share(mesh), m}; }

const Mesh kSquare = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});

struct Placement {
  const char* name;
  glm::dmat4 world;
};
std::vector<Placement> placements() {
  const glm::dmat4 turned = rotation({10, 20, 30});
  return {{"plain", glm::dmat4(1)},
          {"turned", turned},
          {"small", turned * scaling(glm::dvec3(1e-3))},
          {"large", turned * scaling(glm::dvec3(1e3))},
          {"far", translation({1e6, -1e6, 1e6}) * turned},
          {"far unturned", translation({1e6, 1e6, 1e6})}};
}

TEST(PlaneClasses, aQuadAndAFanOfSliversAreOneClass) {
  for (const Placement& p : placements()) {
    for (const unsigned slivers : {1u, 50u, 500u}) {
      EXPECT_EQ(classesOf({at(kSquare, p.world), at(fanSquare(0, slivers), p.world)}), 1u) << p.name << ", " << slivers;
      EXPECT_EQ(classesOf({at(kSquare, p.world), at(flipped(fanSquare(0, slivers)), p.world)}), 1u) << p.name << ", " << slivers;
    }
  }
}

TEST(PlaneClasses, leavesTurnedOneByOneMeetAgain) {
  // Two boxes that share a face, one of them placed by another product of matrices.
  const glm::dmat4 a = rotation({10, 20, 30}), b = rotation({10, 20, 30}) * translation({2, 0, 0}) * rotation({90, 0, 0});
  EXPECT_EQ(classesOf({at(box({0, 0, 0}, {2, 2, 2}), a), at(box({0, 0, -2}, {2, 2, 0}), b)}), 7u);
}

TEST(PlaneClasses, aFineSphereDoesNotFlowTogether) {
  const Mesh mesh = sphere(1, 300, 150);
  // The poles' fans are flat, and the two triangles of a patch too: all else is apart.
  const std::size_t patches = 300 * 149;
  EXPECT_GE(classesOf({at(mesh)}), patches);
  EXPECT_LE(classesOf({at(mesh)}), 2 * patches + 2);
}

TEST(PlaneClasses, boxesHaveSixHoweverTheyAreFaceted) {
  for (const Placement& p : placements()) {
    EXPECT_EQ(classesOf({at(box({0, 0, 0}, {1, 2, 3}, true), p.world)}), 6u) << p.name;
    EXPECT_EQ(classesOf({at(box({0, 0, 0}, {1, 2, 3}, false), p.world)}), 6u) << p.name;
  }
}

TEST(PlaneClasses, theOrderOfFacetsDoesNotMatter) {
  std::mt19937 random(3);
  Mesh mesh = joined(joined(sphere(1, 20, 10), box({-1, -1, -1}, {1, 1, 1})), box({0, 0, -1}, {2, 2, 1}));
  const auto partition = [](const Mesh& m) {
    const Scene scene({at(m, rotation({10, 20, 30}))});
    const PlaneClasses planes(scene, 0);
    std::vector<std::set<std::set<unsigned>>> classes(planes.classes().size());
    for (unsigned t = 0; t < m.triangles.size(); ++t) {
      classes[planes.classOf(0, t)].insert({m.triangles[t].x, m.triangles[t].y, m.triangles[t].z});
    }
    return std::set<std::set<std::set<unsigned>>>(classes.begin(), classes.end());
  };
  const auto expected = partition(mesh);
  for (int i = 0; i < 5; ++i) {
    std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
    for (glm::uvec3& t : mesh.triangles) t = {t.z, t.x, t.y};
    EXPECT_EQ(partition(mesh), expected);
  }
}

TEST(PlaneClasses, aGapIsSeenAboveTheToleranceAndNeverBelow) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (double gap = 0.1; gap > 1e-16; gap *= 0.8) {
      const Scene scene({at(kSquare, scaling(glm::dvec3(scale))), at(fanSquare(gap, 3), scaling(glm::dvec3(scale)))});
      const double tolerance = defaultCoplanarTolerance(scene);
      EXPECT_NEAR(tolerance, 1e-10 * scene.bounds().diagonal(), 1e-3 * tolerance);
      const std::size_t expected = gap * scale > tolerance ? 2 : 1;
      EXPECT_EQ(PlaneClasses(scene, 0).classes().size(), expected) << "gap " << gap << " scale " << scale;
    }
  }
}

TEST(PlaneClasses, aTiltIsSeenWhereItsRiseExceedsTheTolerance) {
  for (double rise = 0.1; rise > 1e-16; rise *= 0.8) {
    // The second square hinges on an edge of the first and rises that much at the other.
    const Mesh tilted = quad({0, 0, 0}, {1, 0, 0}, {1, 0.5, rise}, {0, 0.5, rise}, false);
    const Scene scene({at(kSquare), at(tilted)});
    const std::size_t classes = PlaneClasses(scene, 0).classes().size();
    EXPECT_EQ(classes, rise > defaultCoplanarTolerance(scene) ? 2u : 1u) << rise;
  }
}

TEST(PlaneClasses, anOptionalToleranceOfAnySizeIsKept) {
  for (const double tolerance : {1e-12, 1e-8, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    for (int i = 0; i < 200; ++i) {   // wherever the plane lies
      const double z = i * 0.00731;
      EXPECT_EQ(classesOf({at(box({0, 0, -1}, {1, 1, 3})), at(fanSquare(z, 1)), at(fanSquare(z + 0.9 * tolerance, 2))}, tolerance) <= 7, true)
          << tolerance << " at " << z;
    }
  }
}

TEST(PlaneClasses, floatMeshesMeetWithinAFewUlp) {
  std::mt19937 random(5);
  Mesh grid;   // a turned square cut into a grid, rounded to float
  const glm::dmat4 turned = translation({50, 20, 10}) * rotation({10, 20, 30});
  for (int i = 0; i < 11 * 11; ++i) {
    const glm::dvec3 p = transformPoint(turned, {i % 11, i / 11, 0});
    grid.vertices.emplace_back(float(p.x), float(p.y), float(p.z));
  }
  for (unsigned i = 0; i < 10 * 11 - 1; ++i) {
    if (i % 11 == 10) continue;
    grid.triangles.emplace_back(i, i + 1, i + 12), grid.triangles.emplace_back(i, i + 12, i + 11);
  }
  EXPECT_GT(classesOf({at(grid)}), 1u);
  grid.singlePrecision = true;
  EXPECT_EQ(classesOf({at(grid)}), 1u);
}

}  // namespace
}  // namespace copeel::test
