// Translucency by hand: colours unlit, on a black background, in bytes.
#include <gtest/gtest.h>

#include "tests/support/draw.h"
#include "tests/support/models.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

const View kAbove = lookAt({0.021, 0.032, 20}, {0.021, 0.032, 0}, 21, 21, 0.01);
const glm::dvec4 kRed(1, 0, 0, 1), kGreen(0, 1, 0, 1), kBlue(0, 0, 1, 1);

glm::dvec4 with(glm::dvec4 color, double alpha) { return {glm::dvec3(color), alpha}; }
Tree cube(double half, glm::dvec4 color, glm::dvec3 at = glm::dvec3(0)) { return leaf(box(at - half, at + half), color); }

csg::Frame drawn(const csg::Model& model) {
  csg::RenderOptions options;
  options.lit = false;
  options.scheme.background = {0, 0, 0};
  return draw(model, kAbove, options).frame;
}
Rgb8 middle(const csg::Model& model) { return drawn(model).color.at(10, 10); }
Rgb8 middle(const Tree& tree) { return middle(modelOf(tree)); }

// Colours are a byte apart at most: halves round.
void expectColor(Rgb8 actual, int r, int g, int b) {
  EXPECT_NEAR(actual.r, r, 1);
  EXPECT_NEAR(actual.g, g, 1);
  EXPECT_NEAR(actual.b, b, 1);
}

TEST(Blend, aTranslucentSolidBlendsOnceOverWhatLiesBehind) {
  expectColor(middle(cube(1, with(kRed, 0.5))), 128, 0, 0);
  expectColor(middle(unite({cube(1, with(kRed, 0.25), {0, 0, 3}), cube(1, kBlue)})), 64, 0, 191);
  expectColor(middle(unite({cube(1, with(kRed, 0.5), {0, 0, 6}), cube(1, with(kGreen, 0.5), {0, 0, 3}), cube(1, kBlue)})), 128, 64, 64);
}

// Seen from above, two cubes of equal height in one colour show one plane: the line between them comes from the leaf alone.
TEST(Edges, areBlackWhereOneVisibleFaceEnds) {
  csg::RenderOptions options;
  options.edges = true;
  const View view = lookAt({0.021, 0.032, 20}, {0.021, 0.032, 0}, 41, 41, 0.004);
  const Image<Rgb8> image = draw(modelOf(unite({cube(1, kRed, {-1, 0, 0}), cube(1, kRed, {1, 0, 0})})), view, options).frame.color;
  int black = 0;
  for (int x = 0; x < image.width; ++x) black += image.at(x, 20) == Rgb8{};
  EXPECT_EQ(black, 1);
  EXPECT_EQ(image.at(5, 20), image.at(35, 20));
  EXPECT_NE(image.at(5, 20), Rgb8{});
}

TEST(Blend, wallsBetweenTwoSolidsOfOneUnionDoNotShow) {
  expectColor(middle(unite({cube(1, with(kRed, 0.5), {0, 0, 2}), cube(1, with(kGreen, 0.5))})), 128, 0, 0);       // they touch
  expectColor(middle(unite({cube(1, with(kRed, 0.5), {0, 0, 1}), cube(1, with(kGreen, 0.5))})), 128, 0, 0);       // they overlap
  expectColor(middle(unite({cube(1, with(kRed, 0.5), {0, 0, 2.5}), cube(1, with(kGreen, 0.5))})), 128, 64, 0);    // they do not
}

TEST(Blend, anOpaqueSolidInsideATranslucentOneShows) {
  expectColor(middle(unite({cube(2, with(kRed, 0.5)), cube(1, kBlue)})), 128, 0, 128);
  expectColor(middle(unite({cube(1, kBlue), cube(2, with(kRed, 0.5))})), 128, 0, 128);
}

TEST(Blend, alphaZeroIsNotSeenAndAlphaOneIsOpaque) {
  expectColor(middle(unite({cube(1, with(kRed, 0), {0, 0, 3}), cube(1, kBlue)})), 0, 0, 255);
  expectColor(middle(unite({cube(1, with(kRed, 1), {0, 0, 3}), cube(1, kBlue)})), 255, 0, 0);
  EXPECT_EQ(drawn(modelOf(cube(1, with(kRed, 0)))).ids.at(10, 10), 0);
}

TEST(Blend, aSubtractedSolidOwnsTheFacesItLeaves) {
  const Tree body = cube(2, kRed);
  expectColor(middle(subtract({body, cube(1, kGreen, {0, 0, 1.5})})), 0, 255, 0);
  // Half-transparent cut faces let the opaque body behind them through: nothing of it is entered again, so the background shows.
  expectColor(middle(subtract({body, cube(1, with(kGreen, 0.5), {0, 0, 1.5})})), 0, 128, 0);
  expectColor(middle(subtract({body, cube(1, with(kGreen, 0), {0, 0, 1.5})})), 0, 0, 0);
}

// As openscad does: color([-1, 1, -1, 0.5]) is what color(alpha = 0.5) and the like become in a .csg.
TEST(Blend, whatAColourLeavesOpenTheSchemeDecides) {
  const glm::dvec4 halfOfNothing(-1, -1, -1, 0.5), green(-1, 1, -1, 1);
  const csg::ColorScheme scheme;
  const auto& front = scheme.front;
  const auto& cutout = scheme.cutout;
  expectColor(middle(cube(1, halfOfNothing)), front[0] / 2, front[1] / 2, front[2] / 2);
  expectColor(middle(cube(1, green)), front[0], 255, front[2]);
  const Tree body = cube(2, kRed);
  expectColor(middle(subtract({body, cube(1, halfOfNothing, {0, 0, 1.5})})), cutout[0] / 2, cutout[1] / 2, cutout[2] / 2);
}

// Each part is cut open in its own colour, whatever cut it before; the later one where two overlap.
TEST(Blend, theCapOfASectionBelongsToThePartThatItCuts) {
  const auto cutOpen = [](const Tree& tree, double at) {
    csg::RenderOptions options;
    options.lit = false;
    options.scheme.background = {0, 0, 0};
    options.sections = {{2, at}};
    return draw(modelOf(tree), kAbove, options).frame;
  };
  const Tree red = cube(1, kRed), green = cube(1, kGreen, {0, 0, -1.5}), away = cube(1, kBlue, {0, 0, 40});
  expectColor(cutOpen(unite({red, green, away}), 0.5).color.at(10, 10), 255, 0, 0);
  expectColor(cutOpen(unite({red, green, away}), -2).color.at(10, 10), 0, 255, 0);
  expectColor(cutOpen(unite({red, green}), -0.75).color.at(10, 10), 0, 255, 0);
  expectColor(cutOpen(unite({green, red}), -0.75).color.at(10, 10), 255, 0, 0);
  EXPECT_EQ(cutOpen(unite({red, green, away}), -2).ids.at(10, 10), 2);
  // Below the bottom of a pocket, and what a part cut from a cutter leaves.
  expectColor(cutOpen(subtract({red, cube(1, kGreen, {0, 0, 1.5})}), 0.25).color.at(10, 10), 255, 0, 0);
  expectColor(cutOpen(subtract({red, subtract({cube(2, kGreen), cube(0.5, kBlue)})}), 0.25).color.at(10, 10), 255, 0, 0);
  expectColor(cutOpen(intersect({cube(1, kRed), cube(2, kGreen)}), 0.25).color.at(10, 10), 0, 255, 0);
  // Glass is cut open to glass, and shows the opaque part that it holds.
  expectColor(cutOpen(cube(1, with(kRed, 0.5)), 0.25).color.at(10, 10), 128, 0, 0);
  expectColor(cutOpen(unite({cube(0.5, kBlue), cube(1, with(kRed, 0.5))}), 0.25).color.at(10, 10), 128, 0, 128);
  // A part without a colour has the scheme's front, not that of what is cut out.
  const auto& front = csg::ColorScheme{}.front;
  expectColor(cutOpen(leaf(box(glm::dvec3(-1), glm::dvec3(1))), 0.25).color.at(10, 10), front[0], front[1], front[2]);
}

TEST(Blend, theLaterOperandWinsASharedFace) {
  expectColor(middle(unite({cube(1, kRed), cube(1, kGreen)})), 0, 255, 0);
  expectColor(middle(unite({cube(1, kGreen), cube(1, kRed)})), 255, 0, 0);
  expectColor(middle(intersect({cube(1, kRed), cube(2, kBlue, {0, 0, -1}), cube(1, kGreen)})), 0, 255, 0);
  expectColor(middle(unite({cube(1, kGreen), cube(1, with(kRed, 0.5))})), 128, 128, 0);
}

TEST(Blend, partsWithModifiersLieOverTheSolid) {
  csg::Model model;
  const std::uint32_t solid = addTree(model, cube(1, kBlue)), marked = addTree(model, leaf(box({-1, -1, 2}, {1, 1, 4})));
  model.root = solid;
  model.background = {marked};
  expectColor(middle(model), 90, 90, 90 + 127);
  // A colour of its own goes before the grey.
  model.leaves[1].color = with(kRed, 0.25);
  expectColor(middle(model), 64, 0, 191);
  EXPECT_EQ(drawn(model).ids.at(10, 10), 1);
  model.background = {};
  model.highlight = {solid};
  expectColor(middle(model), 128, 41, 41 + 127);
}

TEST(Blend, samplesAreTheMeanOfTheirCoverage) {
  const csg::Model model = modelOf(leaf(box({-5, -5, -1}, {0.021 + 0.05, 5, 0}), kRed));   // its side passes through the middle pixel
  csg::RenderOptions options;
  options.lit = false;
  options.scheme.background = {0, 0, 0};
  options.samples = 16;
  const csg::Frame frame = draw(model, kAbove, options).frame;
  // A pixel is 0.2 wide here and its left border lies 0.1 left of the eye: three quarters.
  EXPECT_NEAR(frame.color.at(10, 10).r, 255 * 0.75, 17);
  EXPECT_EQ(frame.color.at(10, 10).r * 16 % 255 < 16 || frame.color.at(10, 10).r * 16 % 255 > 239, true);   // a multiple of 1/16
  EXPECT_EQ(frame.color.at(8, 10).r, 255);
  EXPECT_EQ(frame.color.at(13, 10).r, 0);
}

}  // namespace
}  // namespace copeel::test
