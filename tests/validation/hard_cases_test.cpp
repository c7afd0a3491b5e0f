// The rows of the table of hard CSG cases, each at 0 wrong off-edge pixels: against the exact crossings of what was given and, where an exact kernel
// can say what is meant, against the exact Boolean of that.
#include <cmath>

#include <gtest/gtest.h>

#include "validation/exact_boolean.h"
#include "validation/hard_cases.h"
#include "validation/judge.h"

#ifndef COPEEL_IMAGE_SCALE
#define COPEEL_IMAGE_SCALE 1      // the slow suite asks for images five times as wide and high, under a name of its own
#define COPEEL_SUITE HardCases
#endif
#define COPEEL_TEST_OF(suite, name) TEST(suite, name)
#define HARD_CASE(name) COPEEL_TEST_OF(COPEEL_SUITE, name)

namespace copeel::validation {
namespace {

View viewOfCase(Look look) {
  look.width *= COPEEL_IMAGE_SCALE;
  look.height *= COPEEL_IMAGE_SCALE;
  return viewOf(look);
}

void expectRight(const Comparison& c, const char* against, std::size_t look) {
  EXPECT_EQ(c.wrongOffEdge, 0u) << "view " << look << " against " << against << ": " << c.summary();
  EXPECT_EQ(c.wrongLeafOffEdge, 0u) << "view " << look << " against " << against << ": " << c.summary();
  EXPECT_LE(c.wrongEdge, 25u) << "view " << look << " against " << against << ": " << c.summary();
  EXPECT_GT(c.covered, 0u) << "view " << look << " shows nothing";
}

void expectRight(const HardCase& hard) {
  const csg::Model model = modelOf(hard.text);
  std::optional<OracleMesh> truth;
  if (!hard.intended.empty()) {
    truth = exactBoolean(modelOf(hard.intended));
    ASSERT_TRUE(truth && !truth->triangles.empty()) << "no exact Boolean of the intended solid";
    truth = transformedExactly(*truth, hard.motion);
  }
  for (std::size_t i = 0; i < hard.looks.size(); ++i) {
    const View view = viewOfCase(hard.looks[i]);
    expectRight(judgeByRays(model, view), "exact crossings", i);
    if (truth) expectRight(judgeByMesh(model, *truth, view), "the intended solid", i);
  }
}

HARD_CASE(Coplanar_axis_aligned) { expectRight(coplanarDifference()); }
HARD_CASE(Coplanar_scaled_down) { expectRight(coplanarDifference(1e-3)); }
HARD_CASE(Coplanar_scaled_up) { expectRight(coplanarDifference(1e3)); }
HARD_CASE(Coplanar_turned_as_a_whole) { expectRight(coplanarTurnedWhole()); }
HARD_CASE(Coplanar_each_leaf_turned) { expectRight(coplanarTurnedLeafByLeaf()); }
HARD_CASE(Cutter_a_millionth_too_long) { expectRight(cutterTooLong()); }
HARD_CASE(Film_of_a_millionth_stays) { expectRight(filmThatStays()); }
HARD_CASE(Moved_by_a_million) { expectRight(movedFar()); }
HARD_CASE(Self_intersecting_polyhedron) { expectRight(selfIntersecting()); }
HARD_CASE(Inside_out_polyhedron) { expectRight(insideOut()); }
HARD_CASE(Star_prism_with_winding_number_two) { expectRight(starPrism()); }
HARD_CASE(One_face_missing) { expectRight(faceMissing()); }
HARD_CASE(Torus_with_convexity_one) { expectRight(torus()); }
HARD_CASE(Eye_inside_the_cutter) { expectRight(eyeInsideCutter()); }

// Two colours share a face: the later operand's face shows, from both sides of a section and under a third solid that cuts both.
HARD_CASE(Coloured_coincident_faces_show_the_later_operand) {
  const std::string red = "color([1, 0, 0, 1]) {" + box({-20, -20, 0}, {20, 20, 10}) + "}\n";
  const std::string blue = "color([0, 0, 1, 1]) {" + box({-10, -20, 0}, {30, 20, 10}) + "}\n";
  for (const bool redFirst : {true, false}) {
    const std::string both = redFirst ? join("union", {red, blue}) : join("union", {blue, red});
    for (const std::string& text : {both, join("difference", {both, box({-5, -30, 5}, {5, 30, 20})})}) {
      const csg::Model model = modelOf(text);
      for (std::size_t i = 0; const Look& look : usualLooks()) expectRight(judgeByRays(model, viewOfCase(look)), "exact crossings", i++);
    }

    // And said without an oracle: straight down on the shared top at (0, 0), the second leaf shows in its own colour.
    csg::RenderOptions options;
    options.wantIds = true;
    options.lit = false;
    const csg::Frame frame = csg::Renderer(modelOf(both), options).draw(viewOf(usualLooks()[2]));
    EXPECT_EQ(frame.ids.at(100, 75), 2);
    EXPECT_EQ(frame.color.at(100, 75), (redFirst ? Rgb8{0, 0, 255} : Rgb8{255, 0, 0}));
  }
}

// A film between the cutter and the face is there exactly when it is thicker than the declared tolerance: 1e-10 of the scene's diagonal, or 16 ulp.
HARD_CASE(Films_flip_at_the_declared_tolerance_only) {
  for (const double tilt : {0.0, 7.0}) {
    const double diagonal = boundsOf(modelOf(film(1, tilt).text)).diagonal();
    for (int power = 1; power <= 15; ++power) {
      const double thickness = std::pow(10.0, -power) * diagonal;
      // At the tolerance itself the answer may be either.
      if (power == 10) continue;
      const HardCase hard = film(thickness, tilt);
      Look look = hard.looks[2];
      look.width = look.height = 32;
      csg::RenderOptions options;
      options.wantIds = true;
      const csg::Frame frame = csg::Renderer(modelOf(hard.text), options).draw(viewOf(look));
      // Above the hole, between its middle and its side.
      for (const auto& [x, y] : {std::pair{16, 16}, {13, 17}, {18, 14}})
        EXPECT_EQ(frame.ids.at(x, y), thickness > 1e-10 * diagonal ? 1 : 0) << "film of 1e-" << power << " of the diagonal, tilted by " << tilt;
    }
  }
}

}  // namespace
}  // namespace copeel::validation
