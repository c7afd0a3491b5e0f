// Depth values and orders: against closed forms, and where planes are seen edge-on, cross, or lie very near and very far.
#include <bit>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/stacks.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

using Real = long double;
using Vec = glm::vec<3, Real>;

struct Prepared {
  Prepared(std::vector<Object> objects, View v) : scene(std::move(objects)), planes(scene, 0), view(v), frame(scene, planes, view) {}
  Scene scene;
  PlaneClasses planes;
  View view;
  cpu::Frame frame;

  double depth(std::uint32_t primitive, int x, int y) const {
    const DepthPlane& p = frame.depths[planeClass(primitive)];
    const double u = x + 0.5 - view.width * 0.5, v = y + 0.5 - view.height * 0.5;
    return distanceOf(std::clamp(p.a * u + (p.b * v + p.c), double(p.lo), double(p.hi)), view);
  }
  std::uint32_t planeClass(std::uint32_t primitive) const {
    const std::uint32_t object = scene.objectOf(primitive);
    return planes.classOf(object, scene.objects()[object].mesh->facetOf(primitive - scene.firstPrimitive(object)));
  }
  // Along the ray of a sample, to the true plane.
  Real trueDepth(std::uint32_t primitive, int x, int y) const {
    const std::uint32_t object = scene.objectOf(primitive);
    const glm::uvec3 t = scene.objects()[object].mesh->triangles[primitive - scene.firstPrimitive(object)];
    const Real u = x + 0.5L - view.width * 0.5L, v = y + 0.5L - view.height * 0.5L;
    const Vec across = u * Vec(view.right) + v * Vec(view.down), forward(view.forward);
    const Vec origin = view.perspective ? Vec(view.eye) : Vec(view.eye) + across, ray = view.perspective ? forward + across : forward;
    const Vec p(scene.worldVertex(object, t.x));
    const Vec n = glm::cross(Vec(scene.worldVertex(object, t.y)) - p, Vec(scene.worldVertex(object, t.z)) - p);
    return glm::dot(n, p - origin) / glm::dot(n, ray);
  }
};

TEST(Depth, equalsTheClosedFormFromNearToFar) {
  for (const bool perspective : {true, false}) {
    for (const double distance : {1e-3, 1.0, 1e3, 1e6}) {
      const double size = distance * 0.4;
      // A slanted plane at that distance, in one scene with things a thousandth and a million away.
      const Mesh slanted = quad({-size, -size, -distance * 0.8}, {size, -size, -distance}, {size, size, -distance * 1.4}, {-size, size, -distance * 1.2});
      const Mesh nearby = box({-1e-4, -1e-4, -2e-3}, {1e-4, 1e-4, -1e-3}), far = box({-1e6, -1e6, -2e6}, {1e6, 1e6, -1e6});
      const View view = lookAt({0, 0, 0}, {0, 0, -1}, 64, 48, perspective ? 0.01 : size * 0.02, perspective);
      const Prepared p({{share(slanted)}, {share(nearby)}, {share(far)}}, view);
      for (int y = 0; y < 48; y += 5) {
        for (int x = 0; x < 64; x += 7) {
          const Real truth = p.trueDepth(0, x, y);
          if (truth < distance * 0.8 || truth > distance * 1.4) continue;   // held to the face's range elsewhere
          EXPECT_NEAR(p.depth(0, x, y), double(truth), 1e-9 * distance) << x << ", " << y;
        }
      }
    }
  }
}

// Whatever bits of the error they carry; scenes of any size, in front of the eye and around it.
TEST(Depth, rangesHoldTheirFaces) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> at(-1, 1);
  int unknown = 0;
  for (int round = 0; round < 400; ++round) {
    const bool perspective = round % 2;
    const double scale = std::pow(10.0, round % 59 - 30);
    Mesh mesh;
    for (int i = 0; i < 24; ++i) mesh.vertices.push_back(scale * glm::dvec3(at(random), at(random), at(random)));
    for (std::uint32_t i = 0; i < 24; i += 3) mesh.triangles.push_back({i, i + 1, i + 2});
    const glm::dvec3 eye = scale * (round % 3 == 0 ? mesh.vertices[0] / scale : glm::dvec3(3 * at(random), 5, 3 * at(random)));
    const Prepared p({{share(mesh)}}, lookAt(eye, {0, 0, 0}, 33, 33, perspective ? 0.02 : 0.02 * scale, perspective));
    const double nearest = nearDistance(p.scene, p.view);
    for (std::uint32_t i = 0; i < 8; ++i) {
      const DepthPlane& plane = p.frame.depths[p.planeClass(i)];
      for (int corner = 0; corner < 3; ++corner) {
        const Real t = glm::dot(Vec(mesh.vertices[mesh.triangles[i][corner]]) - Vec(p.view.eye), Vec(p.view.forward));
        const Real s = perspective ? -1 / std::max(t, Real(nearest)) : t;
        EXPECT_LE(Real(plane.lo), s) << "round " << round;
        EXPECT_GE(Real(plane.hi), s) << "round " << round;
      }
      unknown += std::isinf(plane.error());
      int exponent = 0;
      if (!std::isinf(plane.error())) { EXPECT_EQ(std::frexp(plane.error(), &exponent), 0.5) << "round " << round; }
    }
  }
  EXPECT_GT(unknown, 0);
}

TEST(Depth, errorsAreReadBackFromTheBitsTheyAreKeptIn) {
  const auto planeOf = [](std::uint32_t exponent) {
    const auto withBits = [](float value, std::uint32_t bits) { return std::bit_cast<float>((std::bit_cast<std::uint32_t>(value) & ~15u) | bits); };
    return DepthPlane{0, 0, 0, withBits(-1, exponent >> 4), withBits(1, exponent & 15)};
  };
  for (std::uint32_t exponent = 0; exponent < 255; ++exponent) EXPECT_EQ(planeOf(exponent).error(), std::ldexp(1.0, static_cast<int>(exponent) - 180));
  EXPECT_TRUE(std::isinf(planeOf(255).error()));
}

TEST(Depth, errorBoundsHold) {
  std::mt19937 random(9);
  std::uniform_real_distribution<double> at(-1, 1);
  for (int round = 0; round < 300; ++round) {
    const bool perspective = round % 2;
    Mesh mesh;
    const double thin = std::pow(10.0, -(round % 12));
    const glm::dvec3 a(at(random), at(random), at(random)), b(at(random), at(random), at(random));
    mesh.vertices = {a, b, a + (b - a) * 0.3 + thin * glm::dvec3(at(random), at(random), at(random))};
    mesh.triangles = {{0, 1, 2}};
    const Prepared p({{share(mesh)}, {share(box({-2, -2, -2}, {2, 2, 2}))}}, lookAt({3 * at(random), 5, 3 * at(random)}, {0, 0, 0}, 33, 33, 0.02, perspective));
    const DepthPlane& plane = p.frame.depths[p.planeClass(0)];
    for (int i = 0; i < 33; i += 8) {
      const double u = i + 0.5 - 16.5;
      const Real t = p.trueDepth(0, i, i), s = perspective ? -1 / t : t;
      const Real truth = std::clamp(s, Real(plane.lo), Real(plane.hi)), value = std::clamp(plane.a * u + (plane.b * u + plane.c), double(plane.lo), double(plane.hi));
      EXPECT_LE(std::abs(double(value - truth)), plane.error()) << "round " << round;
    }
  }
}

// Groups must ascend in true depth, and hold equal depths only.
void expectOrdered(const Prepared& p, const Stacks& stacks, double tolerance) {
  for (int y = 0; y < stacks.height; ++y) {
    for (int x = 0; x < stacks.width; ++x) {
      Real last = -INFINITY;
      for (const Group& group : stacks.at(x, y)) {
        Real least = INFINITY, most = -INFINITY;
        for (const Crossing& c : group) {
          const DepthPlane& plane = p.frame.depths[p.planeClass(c.primitive)];
          Real s = p.trueDepth(c.primitive, x, y);
          if (p.view.perspective) s = -1 / s;
          s = std::isfinite(s) ? std::clamp(s, Real(plane.lo), Real(plane.hi)) : (Real(plane.lo) + plane.hi) / 2;
          least = std::min(least, s), most = std::max(most, s);
        }
        ASSERT_LE(most - least, tolerance) << x << ", " << y;
        ASSERT_GE(least, last - tolerance) << x << ", " << y;
        last = least;
      }
    }
  }
}

TEST(Depth, facesSeenEdgeOnKeepTheirOrder) {
  for (const bool perspective : {true, false}) {
    for (double angle = 1e-3; angle > 1e-10; angle /= 10) {
      std::vector<Object> objects;
      for (int i = 0; i < 12; ++i) {
        const double rise = angle * i;
        objects.push_back({share(quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 2 * std::sin(rise)}, {-1, 1, 2 * std::sin(rise)}))});
      }
      objects.push_back({share(box({-0.5, -0.5, -0.5}, {0.5, 0.5, 0.5}))});
      const Prepared p(std::move(objects), lookAt({0.01, -5, 1e-12}, {0.01, 0, 1e-12}, 41, 41, perspective ? 1e-2 : 5e-2, perspective));
      expectOrdered(p, stacksOf(p.frame), 1e-9);
    }
  }
}

TEST(Depth, aFaceWhosePlaneHoldsTheEyeDoesNoHarm) {
  for (const double y : {-5.0, -1.0, 0.0, 0.3, 1.0}) {
    const Prepared p({{share(box({-1, -1, -1}, {1, 1, 0}))}}, lookAt({0.1, y, 0}, {0.1, y + 1, 0}, 33, 33, 0.05));
    const Stacks stacks = stacksOf(p.frame);
    for (const auto& pixel : stacks.pixels) {
      for (const Group& group : pixel) {
        for (const Crossing& c : group) ASSERT_LT(c.primitive, p.scene.primitiveCount());
      }
    }
    for (const DepthPlane& plane : p.frame.depths) {
      ASSERT_FALSE(std::isnan(plane.a) || std::isnan(plane.b) || std::isnan(plane.c) || std::isnan(plane.error()));
    }
  }
}

TEST(Depth, aPencilOfPlanesThroughOneLineAgreesWithExactOrder) {
  std::vector<Object> objects;
  for (int i = 0; i < 100; ++i) {
    objects.push_back({share(quad({-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1})), rotation({1.7 * i, 0, 0})});
  }
  const Prepared p(std::move(objects), lookAt({0, -5, 0}, {0, 0, 0}, 9, 9, 0.03));   // the line runs through a row of samples
  const Stacks filtered = stacksOf(p.frame);
  EXPECT_GT(filtered.counts.walk.decidedExactly, 0u);
  cpu::TileOptions exactly;
  exactly.decideAllExactly = true;
  EXPECT_EQ(stacksOf(p.frame, exactly).pixels, filtered.pixels);
  expectOrdered(p, filtered, 1e-12);
}

TEST(Depth, teethThinnerThanAPixelKeepTheirOrder) {
  Mesh teeth;
  for (unsigned i = 0; i < 2000; ++i) teeth.vertices.insert(teeth.vertices.end(), {{i * 1e-3, -1, i % 2 * 1e-3}, {i * 1e-3, 1, i % 2 * 1e-3}});
  for (unsigned i = 0; i + 3 < teeth.vertices.size(); i += 2) teeth.triangles.emplace_back(i, i + 2, i + 3), teeth.triangles.emplace_back(i, i + 3, i + 1);
  const Prepared p({{share(teeth)}, {share(quad({0, -1, 5e-4}, {2, -1, 5e-4}, {2, 1, 5e-4}, {0, 1, 5e-4}))}}, lookAt({1, 0.1, 4}, {1, 0, 0}, 64, 64, 0.01));
  expectOrdered(p, stacksOf(p.frame), 1e-12);
}

}  // namespace
}  // namespace copeel::test
