// Our solids against what openscad exports of them: the same vertices to the last bit of float32 (what its exact format keeps), the same
// volume, closed; and the same triangles where faces are bent, so that the diagonal matters.
#include <gtest/gtest.h>

#include "apps/csg/read_model.h"
#include "tests/csg_read/openscad_peer.h"

namespace copeel::csg {
namespace {

using namespace test;

struct Case {
  const char* name;
  const char* scad;
  bool sameTriangles = false;
};

// Without the caps of an extrusion, which are planar: any diagonals will do there.
std::vector<FloatTriangle> withoutLevel(std::vector<FloatTriangle> triangles) {
  std::erase_if(triangles, [](const FloatTriangle& t) { return t[0][2] == t[1][2] && t[1][2] == t[2][2]; });
  return triangles;
}

class Tessellation : public testing::TestWithParam<Case> {};

TEST_P(Tessellation, isOpenscads) {
  SKIP_WITHOUT_OPENSCAD();
  // Both read the .csg: its six digits are not in question here.
  const std::string csg = csgBy(GetParam().scad);
  const std::vector<FloatTriangle> theirs = exportedBy(csg);
  const Model model = parseCsg(csg, "a.csg", ".", ReadOptions{});
  if (theirs.empty()) {
    EXPECT_TRUE(model.leaves.empty());
    return;
  }
  ASSERT_EQ(model.leaves.size(), 1u);
  const Mesh& mesh = *model.leaves[0].mesh;
  const std::vector<FloatTriangle> ours = trianglesOf(mesh);
  EXPECT_EQ(pointsOf(ours), pointsOf(theirs));
  EXPECT_NEAR(volumeOf(ours), volumeOf(theirs), 1e-6 * std::abs(volumeOf(theirs)));
  EXPECT_EQ(openEdgeCount(ours), 0u);
  if (GetParam().sameTriangles) {
    EXPECT_EQ(normalized(withoutLevel(ours)), normalized(withoutLevel(theirs)));
  }
  ASSERT_EQ(mesh.facets.size(), mesh.triangles.size());
  EXPECT_TRUE(std::is_sorted(mesh.facets.begin(), mesh.facets.end()));
}

const Case kCases[] = {
    {"cube", "cube([1,2,3]);"},
    {"cubeCentered", "cube([1/3,2,3.3],center=true);"},
    {"sphereDefault", "sphere(1);"},
    {"sphereFn", "sphere(7.3,$fn=30);"},
    {"sphereOdd", "sphere(2,$fn=7);"},
    {"sphereFaFs", "sphere(20,$fa=5,$fs=0.7);"},
    {"sphereLeast", "sphere(1,$fn=3);"},
    {"cylinder", "cylinder(h=3,r=2);"},
    {"cylinderFn", "cylinder(h=3,d=2.2,$fn=37,center=true);"},
    {"cone", "cylinder(h=3,r1=2,r2=0,$fn=12);"},
    {"coneDown", "cylinder(h=3,r1=0,r2=5,$fn=12);"},
    {"frustum", "cylinder(h=3,r1=2,r2=5.1,$fn=13);"},
    {"fnFraction", "cylinder(h=3,r=2,$fn=7.9);"},
    {"fnBelowThree", "cylinder(h=3,r=2,$fn=1);"},
    {"cubeNegative", "cube([1,-1,1]);"},
    {"sphereNothing", "sphere(0);"},
    {"cylinderNegative", "cylinder(h=3,r1=-1,r2=2);"},
    {"polyhedron", "polyhedron([[0,0,0],[1,0,0],[1,1,0],[0,1,0],[0.5,0.5,2]],[[0,1,2,3],[1,0,4],[2,1,4],[3,2,4],[0,3,4]]);"},
    {"polyhedronBent1", "polyhedron([[0,0,0],[1,0,0],[1,1,0.3],[0,1,0],[0.5,0.5,2]],[[0,1,2,3],[1,0,4],[2,1,4],[3,2,4],[0,3,4]]);", true},
    {"polyhedronBent2", "polyhedron([[0,0,0],[1,0,0.3],[1,1,0],[0,1,0],[0.5,0.5,2]],[[0,1,2,3],[1,0,4],[2,1,4],[3,2,4],[0,3,4]]);", true},
    {"polyhedronBent3", "polyhedron([[0,0,0],[1,0,0.3],[1,1,0],[0,1,0],[0.5,0.5,2]],[[1,2,3,0],[1,0,4],[2,1,4],[3,2,4],[0,3,4]]);", true},
    {"polyhedronBent4", "polyhedron([[0,0,0],[1,0,0.2],[1,1,-0.3],[0.3,1,0],[0.5,0.5,2]],[[0,1,2,3],[1,0,4],[2,1,4],[3,2,4],[0,3,4]]);", true},
    {"polyhedronBentSide", "polyhedron([[0,0,0],[0,0,1],[0.2,1,1.3],[0,1,0],[2,0.5,0.5]],[[3,2,1,0],[0,1,4],[1,2,4],[2,3,4],[3,0,4]]);", true},
    {"polyhedronBentFive",
     "polyhedron([[0,0,0],[2,0,0.1],[3,1,-0.2],[1,2.2,0.3],[-0.5,1,0],[1,1,3]],[[0,1,2,3,4],[1,0,5],[2,1,5],[3,2,5],[4,3,5],[0,4,5]]);", true},
    {"polyhedronConcave",
     "polyhedron([[0,0,0],[4,0,0],[4,4,0],[2,1,0],[0,4,0],[2,0.5,3]],[[0,1,2,3,4],[1,0,5],[2,1,5],[3,2,5],[4,3,5],[0,4,5]]);"},
    {"extrudeSquare", "linear_extrude(3) square([1/3,2]);"},
    {"extrudePolygon", "linear_extrude(3,center=true) polygon([[0,0],[1/3,0],[1/7,1.23456789]]);"},
    {"extrudePaths", "linear_extrude(3) polygon([[0,0],[9,0],[0,9],[1,1],[4,1],[1,4]],paths=[[0,1,2],[3,4,5]]);"},
    {"extrudeDifference", "linear_extrude(3) difference(){circle(3,$fn=12); circle(1); translate([2,0]) square(0.3);}"},
    {"extrudeUnion", "linear_extrude(3) {circle(3,$fn=50); translate([2,1]) rotate(13) square([5,1]); translate([9,9]) circle(1);}"},
    {"extrudeIntersection", "linear_extrude(3) intersection(){circle(3,$fn=50); translate([2,1]) circle(3,$fn=40); translate([0,2]) square(4);}"},
    {"extrudeTwist", "linear_extrude(3,twist=90,slices=5) square([1,2]);", true},
    {"extrudeTwistBack", "linear_extrude(3,twist=-130,slices=7) translate([1,0]) circle(1,$fn=9);", true},
    {"extrudeTwistAuto", "linear_extrude(30,twist=200) square([10,2]);", true},
    {"extrudeTwistFn", "linear_extrude(30,twist=200,$fn=31) difference(){square([10,2],center=true); circle(0.5);}", true},
    {"extrudeTwistScale", "linear_extrude(30,twist=200,scale=0.4) square([10,2]);", true},
    {"extrudeTwistScaleUp", "linear_extrude(30,twist=100,scale=3,$fs=1,$fa=3) square([10,2]);", true},
    {"extrudeTwistScaleUnlike", "linear_extrude(30,twist=100,scale=[3,0.5]) square([10,2]);", true},
    {"extrudeScale", "linear_extrude(3,scale=0.5) square([1,2],center=true);"},
    {"extrudeScaleUnlike", "linear_extrude(3,scale=[2,0.5]) square([1,2]);", true},
    {"extrudeScaleUnlikeFn", "linear_extrude(3,scale=[2,0.5],$fn=6) square([1,2]);", true},
    {"extrudeToPoint", "linear_extrude(3,scale=0) square([1,2],center=true);"},
    {"extrudeToLine", "linear_extrude(3,scale=[0,1]) square([1,2],center=true);"},
    {"extrudeSlicesStraight", "linear_extrude(3,slices=4) square([1,2]);"},
    {"extrudeNegative", "linear_extrude(-3) square(1);"},
    {"extrudeMirrored", "linear_extrude(3) mirror([1,0]) polygon([[0,0],[3,0],[0,1/3]]);"},
    {"extrudeBowTie", "linear_extrude(1) polygon([[0,0],[2,2],[2,0],[0,2]]);"},
    {"polyhedronTie1", "polyhedron([[0,0,0],[0,1,0],[1,1,0.3],[1,0,0],[0.5,0.5,2]],[[3,2,1,0],[4,0,1],[4,1,2],[4,2,3],[4,3,0]]);", true},
    {"rotate", "rotate_extrude() translate([3,0]) circle(1,$fn=12);"},
    {"rotateFn", "rotate_extrude($fn=7) translate([3,0]) square([1,2]);"},
    {"rotateOnAxis", "rotate_extrude($fn=16) square([1,2]);"},
    {"rotateAngle", "rotate_extrude(angle=270,$fn=12) translate([3,0]) square(1);"},
    {"rotateAngleBack", "rotate_extrude(angle=-100,$fn=12) translate([3,0]) polygon([[0,0],[1,0],[0,1]]);"},
    {"rotateNegativeSide", "rotate_extrude(angle=100,$fn=12) translate([-3,0]) polygon([[0,0],[1,0],[0,1]]);"},
    {"rotateNegativeSideFull", "rotate_extrude($fn=12) translate([-3,0]) polygon([[0,0],[1,0],[0,1]]);"},
    {"rotateHole", "rotate_extrude($fn=10) translate([5,0]) difference(){square(2); translate([0.5,0.5]) square(1);}"},
    {"rotateSmallAngle", "rotate_extrude(angle=3) translate([3,0]) square(1);"},
    {"rotateAcross", "rotate_extrude() square(1,center=true);"},
};

INSTANTIATE_TEST_SUITE_P(All, Tessellation, testing::ValuesIn(kCases), [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace copeel::csg
