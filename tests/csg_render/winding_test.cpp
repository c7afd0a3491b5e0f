// Inside rules on meshes that are not simple solids, eyes in odd places, and sections.
#include <gtest/gtest.h>

#include "tests/support/draw.h"
#include "tests/support/models.h"
#include "tests/support/oracle.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

using csg::InsideRule;

csg::Frame drawWith(const Tree& tree, const View& view, InsideRule rule, std::vector<csg::Section> sections = {}) {
  csg::RenderOptions options;
  options.inside = rule;
  options.sections = std::move(sections);
  return draw(modelOf(tree), view, options).frame;
}

const View kAbove = lookAt({0.021, 0.032, 20}, {0.021, 0.032, 0}, 41, 41, 0.01);   // a pixel is 0.2 at z = 0

TEST(Winding, aPentagramHasAHoleUnderTheOddRuleOnly) {
  std::vector<glm::dvec2> star;
  for (int i = 0; i < 5; ++i) star.emplace_back(3 * std::sin(radians(144 * i)), 3 * std::cos(radians(144 * i)));
  const Tree tree = leaf(flipped(prism(star, 2)));   // clockwise order
  EXPECT_TRUE(std::isinf(drawWith(tree, kAbove, InsideRule::Odd).depth.at(20, 20)));
  EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::NonZero).depth.at(20, 20), 18);
  EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::Positive).depth.at(20, 20), 18);
  EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::Odd).depth.at(20, 9), 18);   // a point of the star
}

TEST(Winding, insideOutSolidsAreInsideUnlessPositiveIsAsked) {
  const Tree tree = leaf(flipped(box({-1, -1, -1}, {1, 1, 1})));
  EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::NonZero).depth.at(20, 20), 19);
  EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::Odd).depth.at(20, 20), 19);
  EXPECT_TRUE(std::isinf(drawWith(tree, kAbove, InsideRule::Positive).depth.at(20, 20)));
}

TEST(Winding, nestedShellsOfEqualOrientationAreHollowUnderTheOddRuleOnly) {
  const Mesh nested = joined(box({-2, -2, -2}, {2, 2, 2}), box({-1, -1, -1}, {1, 1, 1}));
  const std::vector<csg::Section> cut = {{2, 0.5, false}};   // what lies above z = 0.5 goes
  EXPECT_FLOAT_EQ(drawWith(leaf(nested), kAbove, InsideRule::NonZero, cut).depth.at(20, 20), 19.5);
  EXPECT_FLOAT_EQ(drawWith(leaf(nested), kAbove, InsideRule::Positive, cut).depth.at(20, 20), 19.5);
  EXPECT_FLOAT_EQ(drawWith(leaf(nested), kAbove, InsideRule::Odd, cut).depth.at(20, 20), 21);
}

TEST(Winding, anOpenBoxShowsTheInsideOfItsFarWall) {
  Mesh open = box({-2, -2, -2}, {2, 2, 2}, false);
  open.triangles.erase(open.triangles.begin() + 2, open.triangles.begin() + 4);   // no lid
  EXPECT_FLOAT_EQ(drawWith(leaf(open), kAbove, InsideRule::NonZero).depth.at(20, 20), 22);
  // From below it looks whole, and the eye just above where the lid was is no disaster.
  const View below = lookAt({0.021, 0.032, -20}, {0.02, 0.03, 0}, 41, 41, 0.01);
  EXPECT_NEAR(drawWith(leaf(open), below, InsideRule::NonZero).depth.at(20, 20), 18, 1e-4);
  for (const double z : {-1.0, 1.9, 2.0, 2.1}) {
    const csg::Frame frame = drawWith(leaf(open), lookAt({0.02, 0.03, z}, {1, 0.5, -1}, 41, 41, 0.02), InsideRule::NonZero);
    for (float depth : frame.depth.pixels) ASSERT_FALSE(std::isnan(depth));
  }
}

TEST(Winding, theEyeInACutterSeesTheHoleIsNotThere) {
  const Tree tree = subtract({leaf(box({-4, -4, -4}, {4, 4, 4})), leaf(box({-2, -2, -2}, {2, 2, 2}))});
  const View view = lookAt({0.1, 0.2, 0.3}, {0.1, 0.2, -5}, 21, 21, 0.02);
  EXPECT_FLOAT_EQ(drawWith(tree, view, InsideRule::NonZero).depth.at(10, 10), 2.3f);
}

TEST(Winding, sectionsThatCoincideWithAFaceChangeNothingBesideIt) {
  const Tree tree = leaf(box({-1, -1, -1}, {1, 1, 1}));
  const csg::Frame plain = drawWith(tree, kAbove, InsideRule::NonZero);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_EQ(plain.depth.pixels, drawWith(tree, kAbove, InsideRule::NonZero, {{axis, 1, false}}).depth.pixels);
    EXPECT_EQ(plain.depth.pixels, drawWith(tree, kAbove, InsideRule::NonZero, {{axis, -1, true}}).depth.pixels);
    const csg::Frame nothing = drawWith(tree, kAbove, InsideRule::NonZero, {{axis, 1, true}});
    for (float depth : nothing.depth.pixels) ASSERT_TRUE(std::isinf(depth));
  }
}

TEST(Winding, sectionsShowTheirCaps) {
  const Tree tree = leaf(box({-1, -1, -1}, {1, 1, 1}));
  EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::NonZero, {{2, 0.25, false}}).depth.at(20, 20), 19.75);
  EXPECT_EQ(drawWith(tree, kAbove, InsideRule::NonZero, {{2, 0.25, false}}).ids.at(20, 20), 1);
  for (const double far : {1e9, 1e300}) {
    EXPECT_TRUE(std::isinf(drawWith(tree, kAbove, InsideRule::NonZero, {{2, -far, false}}).depth.at(20, 20)));
    EXPECT_TRUE(std::isinf(drawWith(tree, kAbove, InsideRule::NonZero, {{2, far, true}}).depth.at(20, 20)));
    EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::NonZero, {{2, far, false}}).depth.at(20, 20), 19);
    EXPECT_FLOAT_EQ(drawWith(tree, kAbove, InsideRule::NonZero, {{2, -far, true}}).depth.at(20, 20), 19);
  }
}

}  // namespace
}  // namespace copeel::test
