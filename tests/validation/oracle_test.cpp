// The judge is judged: the oracle against closed forms and against CGAL, and the comparison against images that are wrong on purpose.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "validation/exact_boolean.h"
#include "validation/hard_cases.h"
#include "validation/judge.h"
#include "validation/random_scene.h"

namespace copeel::validation {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

View lookDown(bool perspective, double height = 30) { return viewOf({{0, 0, height}, {0, 0, 0}, {0, 1, 0}, perspective, 64, 48}); }

glm::dvec3 directionOf(const View& view, const Ray& ray) {
  return view.perspective ? view.forward + ray.u * view.right + ray.v * view.down : view.forward;
}
glm::dvec3 originOf(const View& view, const Ray& ray) {
  return view.perspective ? view.eye : view.eye + ray.u * view.right + ray.v * view.down;
}

// Where a line first enters a box, by slabs; infinite when it misses.
double enterBox(const glm::dvec3& origin, const glm::dvec3& direction, const glm::dvec3& low, const glm::dvec3& high) {
  double enter = -kInfinity, leave = kInfinity;
  for (int i = 0; i < 3; ++i) {
    if (direction[i] == 0) {
      if (origin[i] < low[i] || origin[i] > high[i]) return kInfinity;
      continue;
    }
    const double a = (low[i] - origin[i]) / direction[i], b = (high[i] - origin[i]) / direction[i];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter < leave ? enter : kInfinity;
}

TEST(Oracle, A_box_has_the_depth_that_slabs_give) {
  const glm::dvec3 low(-3, -2, -1), high(4, 2.5, 2);
  const csg::Model model = modelOf(box(low, high));
  for (const Look& look : usualLooks(9)) {
    const View view = viewOf(look);
    const CsgOracle oracle(model, view);
    for (int y = 0; y < view.height; y += 3) {
      for (int x = 0; x < view.width; x += 3) {
        const Ray ray = oracle.caster().rayOf(x, y);
        const double expected = enterBox(originOf(view, ray), directionOf(view, ray), low, high);
        const std::optional<Seen> seen = oracle.see(ray);
        ASSERT_EQ(seen.has_value(), expected < kInfinity) << x << ", " << y;
        if (seen) {
          ASSERT_NEAR(seen->depth, expected, 1e-12 * expected);
        }
      }
    }
  }
}

TEST(Oracle, A_fine_sphere_has_the_depth_of_a_sphere) {
  constexpr double kRadius = 5, kFacets = 200;
  const double sagitta = kRadius * (1 - std::pow(std::cos(M_PI / kFacets), 2));   // of a facet bent both ways
  const csg::Model model = modelOf("sphere($fn = 200, $fa = 12, $fs = 2, r = 5);");
  const View view = lookDown(false);
  const CsgOracle oracle(model, view);
  for (int x = 20; x < 44; ++x) {
    const Ray ray = oracle.caster().rayOf(x, 20);
    const glm::dvec3 origin = originOf(view, ray);
    const double across = origin.x * origin.x + origin.y * origin.y;
    if (across > 20) continue;
    const double expected = 30 - std::sqrt(kRadius * kRadius - across);
    const std::optional<Seen> seen = oracle.see(ray);
    ASSERT_TRUE(seen.has_value());
    // The chord lies inside the sphere by at most the sagitta, measured along the normal.
    EXPECT_GE(seen->depth, expected - 1e-9);
    EXPECT_LE(seen->depth, expected + sagitta * kRadius / std::sqrt(kRadius * kRadius - across));
  }
}

// Pixel rays that meet edges and vertices exactly: every closed surface is crossed as often inwards as outwards.
TEST(Oracle, Rays_through_edges_and_vertices_balance) {
  for (const bool perspective : {false, true}) {
    View view = lookDown(perspective);
    // One pixel is one unit at the top face, its centre on whole coordinates.
    view.right = glm::dvec3(1, 0, 0) / (perspective ? 25.0 : 1.0);
    view.down = glm::dvec3(0, -1, 0) / (perspective ? 25.0 : 1.0);
    view.offset = {-0.5, -0.5};
    const csg::Model model = modelOf(box({-4, -4, -5}, {4, 4, 5}) + "cylinder($fn = 4, $fa = 12, $fs = 2, h = 5, r1 = 6, r2 = 0, center = false);\n");
    const CsgOracle oracle(model, view);
    int met = 0;
    for (int y = 0; y < view.height; ++y) {
      for (int x = 0; x < view.width; ++x) {
        int balance = 0;
        for (const Crossing& c : oracle.caster().cross(oracle.caster().rayOf(x, y))) balance += c.winding, ++met;
        ASSERT_EQ(balance, 0) << x << ", " << y;
      }
    }
    EXPECT_GT(met, 150);
  }
}

TEST(Oracle, Films_are_there_for_the_exact_and_gone_for_the_tolerant) {
  // A cutter whose top is 1e-13 below the part's: a film for exact arithmetic, none within the declared tolerance.
  const csg::Model model = modelOf(join("difference", {box({-5, -5, -5}, {5, 5, 5}), box({-2, -2, -9}, {2, 2, 5 - 1e-13})}));
  const View view = lookDown(true);
  const CsgOracle exact(model, view, {0, csg::InsideRule::NonZero, {}}), tolerant(model, view);
  const Ray ray = exact.caster().rayOf(33, 25);
  EXPECT_TRUE(exact.see(ray).has_value());
  EXPECT_FALSE(tolerant.see(ray).has_value());
}

TEST(Oracle, Eye_in_a_solid_sees_what_lies_beyond_its_hole) {
  // Inside the part, then through its cavity onto the cavity's far wall at z = -2.
  const csg::Model model = modelOf(join("difference", {box({-5, -5, -5}, {5, 5, 5}), box({-4, -4, -2}, {4, 4, 2})}));
  const CsgOracle oracle(model, lookDown(true, 4));
  const std::optional<Seen> seen = oracle.see({0.5, 0.5});
  ASSERT_TRUE(seen.has_value());
  EXPECT_NEAR(seen->depth, 6, 1e-12);
  EXPECT_EQ(seen->leaf, 1u);
}

TEST(Oracle, Open_meshes_wind_by_solid_angle) {
  OracleMesh cube = leafMesh(modelOf(box({-1, -1, -1}, {1, 1, 1})), 0);
  EXPECT_TRUE(isClosed(cube));
  EXPECT_NEAR(generalisedWinding(cube, {0.3, 0.2, -0.4}), 1, 1e-12);
  EXPECT_NEAR(generalisedWinding(cube, {3, 2, -4}), 0, 1e-12);
  cube.triangles.pop_back();
  EXPECT_FALSE(isClosed(cube));
}

TEST(ExactBoolean, Both_kernels_agree_in_general_position) {
  const csg::Model model = modelOf(join("difference", {"sphere($fn = 8, $fa = 12, $fs = 2, r = 5);\n", box({-1.3, -2.1, -7}, {2.2, 1.7, 7})}));
  const auto nef = exactBoolean(model, ExactKernel::Nef), corefined = exactBoolean(model, ExactKernel::Corefinement);
  ASSERT_TRUE(nef && corefined);
  EXPECT_TRUE(isClosed(*nef));
  EXPECT_TRUE(isClosed(*corefined));
  const View view = viewOf(usualLooks(7)[0]);
  const MeshOracle a(*nef, view, 10), b(*corefined, view, 10);
  const Comparison c = compareOracles(a, b, b.caster());
  EXPECT_EQ(c.wrongOffEdge, 0u) << c.summary();
  EXPECT_GT(c.covered, 1000u);
}

TEST(ExactBoolean, Crossing_and_open_leaves_have_no_answer) {
  EXPECT_FALSE(exactBoolean(modelOf(selfIntersecting().text)).has_value());
  EXPECT_FALSE(exactBoolean(modelOf(faceMissing().text)).has_value());
}

// Images that are wrong on purpose, one pixel or all.
class WrongImages : public testing::Test {
 protected:
  csg::Model model = modelOf(coplanarDifference().text);
  View view = viewOf(usualLooks()[0]);
  CsgOracle oracle{model, view};
  Image<float> image = depthImage(oracle);
};

TEST_F(WrongImages, The_right_one_passes) {
  const Comparison c = compareDepth(image, oracle, oracle.caster());
  EXPECT_EQ(c.wrongOffEdge + c.wrongEdge, 0u) << c.summary();
  EXPECT_GT(c.touched, 200u);
  EXPECT_LT(c.touched, c.covered / 4);
}

TEST_F(WrongImages, One_pixel_a_thousandth_too_deep_is_found) {
  image.at(100, 90) += 1e-3f;
  const Comparison c = compareDepth(image, oracle, oracle.caster());
  EXPECT_EQ(c.wrongOffEdge, 1u) << c.summary();
}

TEST_F(WrongImages, A_hole_in_the_surface_is_found) {
  image.at(100, 90) = float(kInfinity);
  EXPECT_EQ(compareDepth(image, oracle, oracle.caster()).wrongOffEdge, 1u);
}

TEST_F(WrongImages, An_empty_image_is_wrong_wherever_something_is_seen) {
  const Comparison c = compareDepth(Image<float>(view.width, view.height, float(kInfinity)), oracle, oracle.caster());
  EXPECT_EQ(c.wrongOffEdge + c.wrongEdge, c.covered);
  EXPECT_LT(c.wrongEdge, c.touched / 10);   // edge pixels are the few within 1/256 pixel of an edge
}

TEST_F(WrongImages, An_image_moved_by_a_pixel_is_found) {
  Image<float> moved = image;
  for (int y = 0; y < view.height; ++y)
    for (int x = 1; x < view.width; ++x) moved.at(x, y) = image.at(x - 1, y);
  EXPECT_GT(compareDepth(moved, oracle, oracle.caster()).wrongOffEdge, 1000u);
}

TEST_F(WrongImages, A_wrong_leaf_is_found) {
  Image<std::uint16_t> ids(view.width, view.height, 0);
  for (int y = 0; y < view.height; ++y)
    for (int x = 0; x < view.width; ++x)
      if (const auto seen = oracle.see(oracle.caster().rayOf(x, y))) ids.at(x, y) = std::uint16_t(seen->leaf + 1);
  EXPECT_EQ(compareDepth(image, oracle, oracle.caster(), &ids).wrongLeafOffEdge, 0u);
  ids.at(100, 90) ^= 3;
  EXPECT_EQ(compareDepth(image, oracle, oracle.caster(), &ids).wrongLeafOffEdge, 1u);
}

// What the hard cases catch: a renderer without the declared tolerance shows the films that turning leaf by leaf leaves.
TEST_F(WrongImages, A_renderer_without_tolerance_fails_where_leaves_are_turned) {
  const HardCase hard = coplanarTurnedLeafByLeaf();
  const csg::Model turned = modelOf(hard.text);
  const auto truth = exactBoolean(modelOf(hard.intended));
  ASSERT_TRUE(truth);
  csg::RenderOptions options;
  options.coplanarTolerance = 1e-300;
  std::uint64_t wrong = 0;
  for (const Look& look : hard.looks) wrong += judgeByMesh(turned, transformedExactly(*truth, hard.motion), viewOf(look), options).wrongOffEdge;
  EXPECT_GT(wrong, 100u);
}

}  // namespace
}  // namespace copeel::validation
