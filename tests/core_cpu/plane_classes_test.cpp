// Which faces are of one plane.
#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include <gtest/gtest.h>

#include "core/coplanarity/plane_classes.h"
#include "core/parallel.h"
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

// Turned squares in planes n·x = d, two of each plane, the second cut otherwise and moved along the normal by `gap`. Many lone ones hide the pairs.
std::vector<Object> pairsOfSquares(int pairs, int lone, double gap, double far) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> angle(0, 360), place(-50, 50);
  std::vector<Object> objects;
  for (int i = 0; i < pairs + lone; ++i) {
    const glm::dmat4 turned = translation(glm::dvec3(far)) * rotation({angle(random), angle(random), angle(random)});
    const double z = place(random), x = place(random);
    objects.push_back(at(quad({x, 0, z}, {x + 2, 0, z}, {x + 2, 2, z}, {x, 2, z}), turned));
    if (i < pairs) objects.push_back(at(quad({x + 1, 1, z + gap}, {x + 2, 1.5, z + gap}, {x + 2, 2.5, z + gap}, {x + 1, 3, z + gap}), turned));
  }
  return objects;
}

TEST(PlaneClasses, pairsAreFoundAmongThousandsWhereverTheirCellsLie) {
  for (const double far : {0.0, 1e6}) {
    for (const double gap : {0.0, 1e-15}) EXPECT_EQ(classesOf(pairsOfSquares(3000, 3000, gap, far)), 6000u) << far << ", gap " << gap;
    EXPECT_EQ(classesOf(pairsOfSquares(3000, 3000, 1e-6, far)), 9000u) << far;
  }
}

TEST(PlaneClasses, aPlaneOnTheBorderOfItsCellIsOneWithItsTwin) {
  // Planes at all multiples of a quarter cell of the offset, each with a twin that rounding parts from it; the box sets the diagonal.
  for (const double tolerance : {1e-8, 1e-6, 1e-4}) {
    std::vector<Object> objects{at(box({-50, -50, -50}, {50, 50, 50}))};
    const double cell = tolerance * 1e4;
    const int count = static_cast<int>(std::min(2000.0, 160 / cell));
    for (int i = 1; i <= count; ++i) {
      const double z = i * cell / 4;
      objects.push_back(at(kSquare, translation({0, 0, z})));
      objects.push_back(at(fanSquare(0, 2), translation({0, 0, z + 0.9 * tolerance * (i % 3 - 1)})));
    }
    EXPECT_EQ(classesOf(std::move(objects), tolerance), 6u + static_cast<unsigned>(count)) << tolerance;
  }
}

TEST(PlaneClasses, theSignOfANormalMayBeUnsure) {
  // Planes through a direction in which normals are told from their opposites: rounding turns some of them round.
  const glm::dvec3 half(0.3568220897730899, 0.5773502691896258, 0.7343224509861237);
  for (int i = 0; i < 360; ++i) {
    const glm::dvec3 side = glm::normalize(glm::cross(half, glm::dvec3(std::cos(i), std::sin(i), 0.3))), along = half;
    const Mesh a = quad(-along, side - along, side + along, along), b = quad(0.3 * side, 1.7 * side + 0.1 * along, 1.7 * side + along, 0.3 * side + along);
    EXPECT_EQ(classesOf({at(a), at(b), at(flipped(b)), at(flipped(a))}), 1u) << i;
  }
}

TEST(PlaneClasses, aTinyFacetFindsTheLargeOneNextDoor) {
  // So small that it may be tilted by a cell's width and more: it looks into the cell of the square, which need not look into its own.
  for (double tilt = 0.51e-6; tilt < 0.6e-6; tilt += 0.01e-6) {
    const Mesh tiny = quad({0.5, 0.5, 0}, {0.50001, 0.5, 1e-5 * tilt}, {0.50001, 0.50001, 1e-5 * tilt}, {0.5, 0.50001, 0});
    EXPECT_EQ(classesOf({at(kSquare), at(tiny)}), 1u) << tilt;
  }
}

TEST(PlaneClasses, theOrderOfObjectsDoesNotMatter) {
  // Which objects (of one facet each) are of one class, under their numbers in the first order.
  const auto partitionOf = [](const std::vector<Object>& objects, const std::vector<unsigned>& order) {
    std::vector<Object> ordered;
    for (const unsigned i : order) ordered.push_back(objects[i]);
    const Scene scene(std::move(ordered));
    const PlaneClasses planes(scene, 0);
    std::vector<std::set<unsigned>> classes(planes.classes().size());
    for (unsigned k = 0; k < order.size(); ++k) classes[planes.classOf(k, 0)].insert(order[k]);
    return std::set<std::set<unsigned>>(classes.begin(), classes.end());
  };
  const std::vector<Object> objects = pairsOfSquares(500, 500, 1e-15, 0);
  std::vector<unsigned> order(objects.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto expected = partitionOf(objects, order);
  std::mt19937 random(2);
  for (int i = 0; i < 3; ++i) {
    std::shuffle(order.begin(), order.end(), random);
    EXPECT_EQ(partitionOf(objects, order), expected);
  }
}

TEST(PlaneClasses, oneThreadOrTwoMakeTheSameClasses) {
  const Scene scene(pairsOfSquares(2000, 2000, 1e-15, 0));
  const auto formed = [&](int threads) {
    PlaneClasses planes;
    Threads(threads).execute([&] { planes = PlaneClasses(scene, 0); });
    return planes;
  };
  const PlaneClasses one = formed(1), two = formed(2);
  ASSERT_EQ(one.classes().size(), two.classes().size());
  for (std::size_t i = 0; i < one.classes().size(); ++i) {
    const PlaneClass &a = one.classes()[i], &b = two.classes()[i];
    EXPECT_TRUE(a.normal == b.normal && a.normalError == b.normalError && a.object == b.object && a.triangle == b.triangle);
    EXPECT_TRUE(a.boundsMin == b.boundsMin && a.boundsMax == b.boundsMax);
  }
  for (unsigned object = 0; object < scene.objects().size(); ++object) EXPECT_EQ(one.classOf(object, 0), two.classOf(object, 0));
}

TEST(PlaneClasses, aClassHoldsItsFacesAndIsThatOfItsRepresentative) {
  const Scene scene(pairsOfSquares(300, 300, 1e-15, 1e6));
  const PlaneClasses planes(scene, 0);
  for (unsigned object = 0; object < scene.objects().size(); ++object) {
    const PlaneClass& planeClass = planes.classes()[planes.classOf(object, 0)];
    EXPECT_EQ(planes.classOf(planeClass.object, 0), planes.classOf(object, 0));
    for (unsigned v = 0; v < 4; ++v) {
      const glm::dvec3 p = scene.worldVertex(object, v);
      EXPECT_TRUE(glm::all(glm::lessThanEqual(glm::dvec3(planeClass.boundsMin), p)) && glm::all(glm::lessThanEqual(p, glm::dvec3(planeClass.boundsMax))));
      const glm::dvec3 q = scene.worldVertex(planeClass.object, 0);
      EXPECT_LE(std::abs(glm::dot(planeClass.normal, p - q)), planes.tolerance());
    }
  }
}

}  // namespace
}  // namespace copeel::test
