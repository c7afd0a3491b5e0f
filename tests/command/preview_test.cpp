// Our picture beside openscad's own for the same options, of models without coincident faces, where its preview can be trusted: the same
// coverage, so the same camera and the same --viewall box, and the same colours.
#include <algorithm>
#include <cstdlib>
#include <ostream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/image/write_image.h"
#include "tests/command/program.h"

namespace copeel {
namespace {

struct Scene {
  const char* name;
  const char* source;
  const char* options;
  bool colorsAreOurs = false;   // translucent parts are drawn by a rule of our own
};

// The name of a test case, the same in every build.
void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

constexpr Scene kScenes[] = {
    {"placed_boxes_count", "rotate([20,30,40]) cylinder(r=5,h=20,$fn=40);", ""},
    {"intersection_takes_all_leaves", "intersection() { rotate([0,45,0]) cube(20,center=true); translate([5,0,0]) sphere(10,$fn=30); }", ""},
    {"cutters_do_not_count",
     "difference() { rotate([10,0,33]) cube([30,20,10]); translate([5,5,-20]) cylinder(r=3,h=60,$fn=24); translate([60,0,0]) cube(5); }", ""},
    {"unions_intersected",
     "intersection() { union() { cube(10); translate([30,0,0]) sphere(8); } union() { translate([4,4,4]) rotate([0,0,45]) "
     "cube([50,10,10],center=true); translate([31,1,0]) cylinder(r=3,h=30,center=true); } }", ""},
    {"cut_from_a_cutter",
     "difference() { cube(20); difference() { translate([-1,-1,5]) cube([30,30,30]); translate([5,5,0]) rotate([0,0,20]) cube([10,10,60]); } }", ""},
    {"empty_products_do_not_count",
     "intersection() { cube(20); difference() { sphere(18,$fn=20); cylinder(r=3,h=50,center=true); } translate([0,0,3]) "
     "cube([90,90,4],center=true); } translate([40,0,0]) intersection() { cube(5); translate([9,0,0]) cube(2); }", ""},
    {"mirrored_and_twisted", "scale([1,2,0.5]) mirror([1,0,0]) rotate([0,0,30]) linear_extrude(10,twist=40,slices=8) square([10,4]);", ""},
    {"background_counts", "cube(8); %translate([30,0,0]) cube(5);", "", true},
    {"flat_shapes_are_measured_flat", "square(5); translate([16,16]) scale([1,1,6]) rotate([45,0,0]) square(5);", ""},
    {"hash_is_seen_through", "#cube(9); translate([3,3,3]) cube(3); translate([12,0,0]) difference() { #cube(5); translate([2,2,-1]) cube(7); }", "", true},
    {"ghosts_within_a_hull", "hull() { %translate([0,0,3]) cube(9); cube(4); } linear_extrude(2) { %translate([20,0]) circle(3); square(2); }", "", true},
    {"orthographic", "rotate([10,20,30]) cube([10,20,30]);", "--projection=o --camera=1,2,3,70,10,200,90"},
    {"other_colours", "difference() { cube(20,center=true); cylinder(r=5,h=40,center=true,$fn=40); }", "--colorscheme=Sunset --camera=60,-50,80,0,0,0"},
    {"colours_left_open",
     "color([-1,1,0.5,1]) cube(10); translate([15,0,0]) color(alpha=0.5) color(\"red\") cube(10); translate([30,0,0]) color([1,0,1]) "
     "color(alpha=0.2) cube(10); translate([0,20,0]) difference() { cube(10); color([-1,-1,1]) translate([2,2,5]) cube([6,6,9]); } "
     "translate([15,20,0]) %color([0,0,1]) cube(10);", "--colorscheme=Tomorrow"},
    {"coloured", "color(\"SteelBlue\") rotate([0,0,15]) cube(10); color([0.9,0.3,0.1]) translate([12,3,1]) sphere(6,$fn=24);", ""},
};

constexpr int kColorTolerance = 1;   // levels; openscad rounds in float32

class Preview : public ProgramTest, public ::testing::WithParamInterface<Scene> {};

bool nearby(const Rgb8& a, const Rgb8& b) {
  return std::abs(a.r - b.r) <= kColorTolerance && std::abs(a.g - b.g) <= kColorTolerance && std::abs(a.b - b.b) <= kColorTolerance;
}

// The 3×3 pixels around are of one colour: no silhouette, crease or facet edge is near.
bool isFlat(const Image<Rgb8>& image, int x, int y) {
  for (int j = std::max(0, y - 1); j < std::min(image.height, y + 2); ++j) {
    for (int i = std::max(0, x - 1); i < std::min(image.width, x + 2); ++i) {
      if (image.at(i, j) != image.at(x, y)) return false;
    }
  }
  return true;
}

TEST_P(Preview, AgreesWithOpenscadOffEdges) {
  if (std::system("command -v openscad >/dev/null && command -v xvfb-run >/dev/null") != 0) GTEST_SKIP() << "no openscad or no xvfb-run";
  const Scene& scene = GetParam();
  write("model.scad", scene.source);
  const std::string options = fmt::format("--imgsize=400,300 {}", scene.options);
  ASSERT_EQ(std::system(fmt::format("cd '{}' && xvfb-run -a openscad -q {} -o theirs.png model.scad >/dev/null 2>&1", folder_.string(), options).c_str()), 0);
  ASSERT_EQ(std::system(fmt::format("cd '{}' && '{}' csg {} -o ours.png model.scad", folder_.string(), COPEEL_PROGRAM, options).c_str()), 0);
  const Image<Rgb8> theirs = readPng((folder_ / "theirs.png").string()), ours = readPng((folder_ / "ours.png").string());
  ASSERT_EQ(ours.pixels.size(), theirs.pixels.size());
  const Rgb8 background = theirs.at(0, 0);
  int covered = 0, edgeWrong = 0, coverageWrong = 0, colorWrong = 0;
  for (int y = 0; y < ours.height; ++y) {
    for (int x = 0; x < ours.width; ++x) {
      const bool differs = (ours.at(x, y) == background) != (theirs.at(x, y) == background);
      const bool flat = isFlat(theirs, x, y);
      covered += ours.at(x, y) != background;
      edgeWrong += differs && !flat;
      coverageWrong += differs && flat;
      colorWrong += !differs && flat && !nearby(ours.at(x, y), theirs.at(x, y));
    }
  }
  EXPECT_GT(covered, 800);
  EXPECT_EQ(coverageWrong, 0);
  EXPECT_LE(edgeWrong, 10);
  if (!scene.colorsAreOurs) {
    EXPECT_EQ(colorWrong, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenes, Preview, ::testing::ValuesIn(kScenes), [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace copeel
