// Files to models: the meaning of trees, what openscad evaluates, .scad, meshes and their expressions.
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "apps/csg/read_model.h"
#include "core/error.h"
#include "core/scene/scene.h"
#include "tests/csg_read/openscad_peer.h"

namespace copeel::csg {
namespace {

using namespace test;

Model parse(const std::string& text) { return parseCsg(text, "part.csg", ".", ReadOptions{}); }

template <class Call>
std::string failureOf(Call call, ExitCode code) {
  try {
    call();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
    return error.what();
  }
  return "no failure";
}

// Whether a point inside all leaves is inside the solid: enough to see what a tree of leaves around the origin means.
bool holdsOrigin(const Model& model) {
  if (model.root == kNoNode) return false;
  std::vector<bool> inside(model.nodes.size());
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    bool value = node.operation == Operation::Leaf || (node.operation == Operation::Intersection && node.childCount > 0);
    for (std::uint32_t c = 0; c < node.childCount; ++c) {
      const bool child = inside[model.childIndices[node.firstChild + c]];
      if (node.operation == Operation::Union) value = value || child;
      if (node.operation == Operation::Intersection) value = value && child;
      if (node.operation == Operation::Difference) value = c == 0 ? child : value && !child;
    }
    inside[i] = value;
  }
  return inside[model.root];
}

// Leaves are cubes of size 2 around the origin: openscad's result is a cube or nothing.
TEST(Semantics, emptyOperandsMeanWhatTheyMeanInOpenscad) {
  SKIP_WITHOUT_OPENSCAD();
  const std::string cube = "cube(2,center=true);";
  const std::string none = "group();";
  const std::string flat = "multmatrix([[1,0,0,0],[0,1,0,0],[0,0,0,0],[0,0,0,1]]) " + cube;
  const std::string nan = "multmatrix([[1,0,0,0],[0,nan,0,0],[0,0,1,0],[0,0,0,1]]) { " + cube + " }";
  const std::string trees[] = {
      "difference() {" + none + cube + "}", "difference() {" + cube + none + "}", "intersection() {" + cube + none + "}",
      "intersection() {" + none + cube + "}", "union() {" + none + cube + "}", "difference();", "union();", "intersection();",
      "difference() { cube(0);" + cube + "}", "intersection() {" + cube + "sphere(r=-1);}", "difference() { %" + cube + cube + "}",
      "difference() {" + cube + "%" + cube + "}", "intersection() {" + cube + "%cube(1);}", "difference() {" + cube + "#" + cube + "}",
      "difference() { #" + cube + "cube(0); }", "difference() { " + nan + cube + "}", "difference() {" + cube + nan + "}",
      "difference() {" + flat + cube + "}", "intersection() {" + cube + "}", "difference() {" + cube + cube + "}",
      "difference() {" + cube + "difference() {" + cube + cube + "} }", "%" + cube, "group() { group() { group(); } }",
      "difference() { intersection() {" + cube + none + "}" + cube + "}", "render(convexity = 1) { color([1,0,0,1]) " + cube + "}",
      "multmatrix([[-1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) {" + cube + "}", "*" + cube, "difference() { *" + cube + cube + "}"};
  for (const std::string& tree : trees) {
    // openscad writes nan, but reads it as the name of a variable.
    EXPECT_EQ(holdsOrigin(parse(tree)), !exportedBy("nan = 0 / 0;" + tree).empty()) << tree;
  }
}

// Both ended the program: a face of one place, and one whose corners lie farther apart than a double reaches.
TEST(Polyhedron, facesOfNoExtentOrOfTooMuch) {
  const Model point = parse("polyhedron(points=[[1,1,0],[1,1,0],[1,1,0],[1,1,0]],faces=[[0,1,2,3]]);");
  EXPECT_EQ(point.leaves.at(0).mesh->triangles.size(), 2u);
  const Model huge = parse("polyhedron(points=[[0,0,0],[1e308,0,0],[-1e308,1e307,0],[0,1e308,0],[-1e308,-1e308,1]],faces=[[0,1,2,3,4]]);");
  EXPECT_EQ(huge.leaves.at(0).mesh->triangles.size(), 3u);
}

TEST(Semantics, anOuterColourThatIsNotWholeGivesWay) {
  const Model model = parse("color([-1,-1,-1,0.5]) { color([1,0,0,1]) cube(1); cube(1); } color([1,0,0,1]) color([-1,-1,-1,0.5]) cube(1); "
                            "color([-1,1,0.5,-1]) cube(1);");
  EXPECT_EQ(*model.leaves[0].color, glm::dvec4(1, 0, 0, 1));
  EXPECT_EQ(*model.leaves[1].color, glm::dvec4(-1, -1, -1, 0.5));
  EXPECT_EQ(*model.leaves[2].color, glm::dvec4(1, 0, 0, 1));
  EXPECT_EQ(*model.leaves[3].color, glm::dvec4(-1, 1, 0.5, 1));
}

TEST(Semantics, theOuterColourShows) {
  const Model model = parse("color([1,0,0,1]) { color([0,0,1,0.5]) cube(1); sphere(1); } cube(1); color(\"#8000\") cube(1); color(\"Tomato\",0.25) cube(1);");
  EXPECT_EQ(*model.leaves[0].color, glm::dvec4(1, 0, 0, 1));
  EXPECT_EQ(*model.leaves[1].color, glm::dvec4(1, 0, 0, 1));
  EXPECT_FALSE(model.leaves[2].color.has_value());
  EXPECT_EQ(model.leaves[3].color->w, 0);
  EXPECT_EQ(model.leaves[4].color->w, 0.25);
}

const glm::dvec4 kUncolored(-1);
glm::dvec4 colorOf(const Model& model, std::size_t leaf) { return model.leaves.at(leaf).color.value_or(kUncolored); }

// openscad's preview takes what carries # out of a union and shows it translucent: what lies within and behind is seen.
TEST(Semantics, whatCarriesHashIsSeenThroughInAUnion) {
  const Model beside = parse("#cube(9); multmatrix([[1,0,0,1]]) { #group() { cube(1); } } sphere(1);");
  EXPECT_TRUE(beside.highlight.empty());
  EXPECT_EQ(colorOf(beside, 0), kHighlightColor);
  EXPECT_EQ(colorOf(beside, 1), kHighlightColor);
  EXPECT_EQ(colorOf(beside, 2), kUncolored);
  // A difference is marked by its first operand, an intersection or a union by all of them.
  const Model product = parse("difference() { #cube(1); color([0,0,1]) cube(1); } intersection() { #cube(1); #cube(1); } union() { #cube(1); #cube(1); } cube(2);");
  EXPECT_TRUE(product.highlight.empty());
  for (std::size_t leaf = 0; leaf < 6; ++leaf) EXPECT_EQ(colorOf(product, leaf), kHighlightColor) << leaf;
  EXPECT_EQ(colorOf(product, 6), kUncolored);
}

// Where it is no operand of the union that is seen, it lies over the solid.
TEST(Semantics, whatCarriesHashElsewhereLiesOverTheSolid) {
  for (const char* text : {"#cube(1);", "#cube(1); #sphere(1);", "difference() { cube(2); #cube(1); } cube(3);", "intersection() { #cube(2); cube(1); } cube(3);",
                           "difference() { union() { #cube(1); cube(2); } cube(1); } cube(3);", "render() { #cube(1); cube(2); } cube(3);",
                           "render() { #cube(1); } cube(3);"}) {
    const Model model = parse(text);
    EXPECT_EQ(model.highlight.size(), 1u) << text;
    for (const Leaf& leaf : model.leaves) EXPECT_FALSE(leaf.color.has_value()) << text;
  }
}

TEST(Semantics, modifiersInsideTrees) {
  const Model model = parse("difference() { cube(3); #cube(1); %sphere(1); } multmatrix([[1,0,0,9]]) { %group() { cube(2); } }");
  ASSERT_EQ(model.highlight.size(), 1u);
  EXPECT_EQ(model.nodes[model.highlight[0]].operation, Operation::Leaf);
  ASSERT_EQ(model.background.size(), 2u);
  EXPECT_EQ(model.leaves[model.nodes[model.background[1]].leaf].worldFromObject[3].x, 9);
  EXPECT_EQ(parse("cube(1); multmatrix([[1,0,0,9]]) { !sphere(1); }").leaves.size(), 1u);
  EXPECT_EQ(parse("cube(1); *sphere(1);").leaves.size(), 1u);
}

TEST(Semantics, aFlatShapeIsASlab) {
  const Model model = parse("multmatrix([[1,0,0,5]]) square([2,3]);");
  const Box box = boundingBox(*model.leaves.at(0).mesh);
  EXPECT_EQ(box.min, glm::dvec3(0, 0, -0.5));
  EXPECT_EQ(box.max, glm::dvec3(2, 3, 0.5));
  const Model mixed = parse("difference() { cube(1); square(1); }\ncube(1); square(1); intersection() { circle(1); square(1); sphere(1); }");
  EXPECT_EQ(mixed.leaves.size(), 5u);
  ASSERT_EQ(mixed.warnings.size(), 2u);
  EXPECT_EQ(mixed.warnings[0], "part.csg:1: 2D and 3D do not mix here: this 2D square is left out");
}

TEST(Semantics, badValuesAreNamed) {
  const auto failure = [](const char* text) { return failureOf([&] { parse(text); }, ExitCode::Input); };
  EXPECT_EQ(failure("polyhedron(points=[[0,0,0],[1,0,0],[0,1,0]],\nfaces=[[0,1,7]]);"), "part.csg:2: face 0 names point 7, but there are 3 points");
  EXPECT_EQ(failure("polyhedron(points=[[0,0,nan]],faces=[]);"), "part.csg:1: point 0 is not 3 finite numbers");
  EXPECT_EQ(failure("\nsphere(1,$fn=1e9);"), "part.csg:2: sphere has more than 1000000 fragments");
  EXPECT_EQ(failure("sphere(1,$fn=1e6);"), "part.csg:1: sphere has more than 2e7 corners");
  EXPECT_EQ(failure("multmatrix([[1,0,true,0]]) cube(1);"), "part.csg:1: an entry of the matrix is no number");
  EXPECT_EQ(failure("color(\"no such\") cube(1);"), "part.csg:1: unknown colour 'no such'");
  EXPECT_EQ(failure("import(file=\"no such.stl\");"), "part.csg:1: ./no such.stl: no such file");
  EXPECT_EQ(failure("polygon(points=[[0,0],[1,0],[0,[1]]]);"), "part.csg:1: point 2 is not 2 finite numbers");
  EXPECT_NE(failure("circle(1e300);cube([1:1e-9:2]);"), "no failure");
  EXPECT_TRUE(parse("cube([inf,1,1]); sphere(r=nan); sphere(r=-nan); cylinder(h=inf); linear_extrude(height=nan) square(1); rotate_extrude(angle=nan) square(1);").leaves.empty());
}

class Files : public testing::Test {
 protected:
  std::string write(const std::string& name, const std::string& text) {
    writeFile(folder_.path() + "/" + name, text);
    return folder_.path() + "/" + name;
  }
  std::size_t fileCount(const std::string& folder) {
    std::size_t count = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) count += entry.exists();
    return count;
  }

  TemporaryFolder folder_{std::filesystem::temp_directory_path().string()};
  ReadOptions options_{"openscad", {}, folder_.path() + "/cache"};
};

constexpr const char* kTetrahedron =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";

TEST_F(Files, scadWithAnyNameImportsBesideItself) {
  SKIP_WITHOUT_OPENSCAD();
  std::filesystem::create_directory(folder_.path() + "/a dir");
  write("a dir/tétra 1.off", kTetrahedron);
  const std::string scad = write("a dir/-pärt \"1\".scad", "import(\"tétra 1.off\"); for (i = [0 : n]) translate([i, 0, 0]) cube(1); foo();");
  options_.definitions = {"n=3"};
  const Model model = readScad(scad, options_);
  EXPECT_EQ(model.leaves.size(), 5u);
  ASSERT_EQ(model.warnings.size(), 1u);
  EXPECT_EQ(model.warnings[0], scad + ":1: Ignoring unknown module 'foo'");
}

TEST_F(Files, scadErrorsAreOneLine) {
  SKIP_WITHOUT_OPENSCAD();
  const auto failure = [&](const std::string& path, ExitCode code = ExitCode::Input) { return failureOf([&] { readScad(path, options_); }, code); };
  const std::string bad = write("bad.scad", "cube(1);\ncube(;\n");
  EXPECT_EQ(failure(bad), bad + ":2: Parser error: syntax error");
  const std::string assertion = write("assert.scad", "cube(1);\n\nassert(false, \"no\");");
  EXPECT_EQ(failure(assertion), assertion + ":3: Assertion 'false' failed: \"no\"");
  EXPECT_NE(failure(folder_.path() + "/none.scad").find("none.scad"), std::string::npos);
  EXPECT_NE(failure(folder_.path()).find(folder_.path()), std::string::npos);
  const std::string zero = write("zero.scad", std::string("cube(1);\nsphere(2\0);", 20));
  EXPECT_EQ(failure(zero), zero + ":2: a zero byte: openscad would read no further");
  options_.openscad = "no-such-openscad";
  EXPECT_EQ(failure(bad, ExitCode::Machine), "no-such-openscad: cannot be run: No such file or directory");
}

// A program in openscad's place: a shell script whose $2 is the .csg to be written.
TEST_F(Files, whatOpenscadSaysAfterItsTextCountsToo) {
  const std::string scad = write("part.scad", "cube(1);");
  const auto openscadIs = [&](const std::string& script) {
    options_.openscad = write("openscad", "#!/bin/sh\n" + script + "\n");
    std::filesystem::permissions(options_.openscad, std::filesystem::perms::owner_all);
  };
  const auto failure = [&](ExitCode code) { return failureOf([&] { readScad(scad, options_); }, code); };
  // The text comes in pieces, and a warning after it.
  openscadIs("exec 3>\"$2\"; echo 'union() {' >&3; sleep 0.02; echo 'cube(1); }' >&3; exec 3>&-; echo 'WARNING: late' >&2");
  const Model model = readScad(scad, options_);
  EXPECT_EQ(model.leaves.size(), 1u);
  EXPECT_EQ(model.warnings, std::vector<std::string>{scad + ": late"});
  openscadIs("echo 'cube(1);' >\"$2\"; sleep 0.02; echo 'ERROR: cause' >&2");
  EXPECT_EQ(failure(ExitCode::Input), scad + ": cause");
  openscadIs("echo 'cube(1);' >\"$2\"; sleep 0.02; exit 3");
  EXPECT_EQ(failure(ExitCode::Machine), scad + ": openscad failed with code 3");
  // A text cut short is the fault of what cut it.
  openscadIs("echo 'cube(' >\"$2\"; kill -9 $$");
  EXPECT_EQ(failure(ExitCode::Machine), scad + ": openscad failed with code 137");
  openscadIs("exit 0");
  EXPECT_EQ(failure(ExitCode::Machine), scad + ": openscad wrote nothing");
  // More than a pipe holds.
  openscadIs("for i in $(seq 20000); do echo 'cube(1);'; done >\"$2\"");
  EXPECT_EQ(readScad(scad, options_).leaves.size(), 20000u);
}

TEST_F(Files, whatOpenscadMustEvaluateIsEvaluatedOnceAndKept) {
  SKIP_WITHOUT_OPENSCAD();
  write("tetra.off", kTetrahedron);
  const std::string text = "hull() { cube(size = [1, 1, 0.1]); multmatrix([[1,0,0,3],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(1); } }\n"
                           "minkowski(convexity = 0) { cube(1); import(file = \"tetra.off\", timestamp = 7); }\n"
                           "linear_extrude(height = 0.123456789) { offset(r = 1, $fn = 16) { square(3); } }\n"
                           "resize(newsize = [4,0,0], auto = [1,1,1]) { import(file = \"tetra.off\"); }\n"
                           "difference() { projection(cut = false) { cube(2); } circle(r = 1, $fn = 5); }\n"
                           "hull();\n";
  const std::string path = write("part.csg", text);
  const Model first = readCsg(path, options_);
  ASSERT_EQ(first.leaves.size(), 6u);
  EXPECT_EQ(boundingBox(*first.leaves[0].mesh).max, glm::dvec3(4, 1, 1));
  EXPECT_EQ(boundingBox(*first.leaves[1].mesh).max, glm::dvec3(2, 2, 2));
  EXPECT_EQ(boundingBox(*first.leaves[2].mesh).max, glm::dvec3(4, 4, 0.123456789));
  EXPECT_EQ(boundingBox(*first.leaves[3].mesh).max, glm::dvec3(4, 4, 4));
  EXPECT_EQ(boundingBox(*first.leaves[4].mesh).max, glm::dvec3(2, 2, 0.5));
  EXPECT_EQ(fileCount(options_.cacheFolder), 6u) << "entries only, no temporary files";
  // The second time nothing is run; indentation and time stamps do not matter.
  const Model second = parseCsg("group() {\n" + text + "}", "b.csg", folder_.path(), options_);
  EXPECT_EQ(fileCount(options_.cacheFolder), 6u);
  EXPECT_EQ(second.leaves.size(), 6u);
  // Another content of the same file is another shape.
  write("tetra.off", std::string(kTetrahedron).replace(8, 5, "0 0 -1"));
  readCsg(path, options_);
  EXPECT_EQ(fileCount(options_.cacheFolder), 8u);
}

// What carries % or # within hull, minkowski and resize is shown beside the one shape that these make, within extrusions it is not.
TEST_F(Files, marksWithinAShapeAreShown) {
  SKIP_WITHOUT_OPENSCAD();
  const Model model = parseCsg("hull() { multmatrix([[1,0,0,7]]) { union() { %cube(8); cube(3); } } cube(1); }\n"
                               "linear_extrude(height = 2) { #square(5); circle(1); *%square(9); }\n"
                               "minkowski() { cube(1); #hull() { cube(2); cube(1); %sphere(1); } }\n", "a.csg", folder_.path(), options_);
  ASSERT_EQ(model.background.size(), 2u);
  ASSERT_EQ(model.highlight.size(), 1u);
  const auto boundsOf = [&](std::uint32_t node) { return boundingBox(*model.leaves.at(model.nodes[node].leaf).mesh); };
  EXPECT_EQ(model.leaves.at(model.nodes[model.background[0]].leaf).worldFromObject[3].x, 7);
  EXPECT_EQ(boundsOf(model.background[0]).max, glm::dvec3(8));
  EXPECT_EQ(boundsOf(model.highlight[0]).max, glm::dvec3(2));
  EXPECT_EQ(model.nodes[model.root].childCount, 3u) << "three shapes alone are the solid";
}

// Each of them costs as much as all below it.
TEST_F(Files, marksInADeepNestingOfShapesCostNoMoreThanAFew) {
  options_.openscad = write("openscad", "#!/bin/sh\nhead -c 84 /dev/zero >\"$4\"\n");
  std::filesystem::permissions(options_.openscad, std::filesystem::perms::owner_all);
  std::string text;
  for (int i = 0; i < 3000; ++i) text += "hull() { #";
  const Model model = parseCsg(text + "cube(9);" + std::string(3000, '}'), "a.csg", folder_.path(), options_);
  EXPECT_LE(model.highlight.size(), 65u);
  EXPECT_LE(fileCount(options_.cacheFolder), 65u);
}

// Copeel's own files and what only they hold are no business of the user.
TEST_F(Files, warningsAboutShapesNameThePlaceInTheModel) {
  SKIP_WITHOUT_OPENSCAD();
  write("s.dat", "0 1\n1 2\n");
  const std::string surface = "surface(file = \"s.dat\", center = false, invert = false, convexity = 1, timestamp = 17);";
  EXPECT_EQ(parseCsg(surface, "a.csg", folder_.path(), options_).warnings, std::vector<std::string>{}) << "openscad writes time stamps, but warns of them";
  const Model model = parseCsg("cube(1);\nhull() { cube(1, flavour = 2); }", "a.csg", folder_.path(), options_);
  EXPECT_EQ(model.warnings, std::vector<std::string>{"a.csg:2: openscad on hull: variable flavour not specified as parameter"});
}

// A power cut may leave an entry empty or half: it is neither believed nor in the way.
TEST_F(Files, aDamagedEntryIsMadeAnew) {
  SKIP_WITHOUT_OPENSCAD();
  const std::string text = "hull() { cube(size = 2); }";
  const auto bounds = [&] {
    const Model model = parseCsg(text, "a.csg", folder_.path(), options_);
    return model.leaves.empty() ? Box{} : boundingBox(*model.leaves[0].mesh);
  };
  EXPECT_EQ(bounds().max, glm::dvec3(2));
  const std::filesystem::path entry = std::filesystem::directory_iterator(options_.cacheFolder)->path();
  const std::uintmax_t size = std::filesystem::file_size(entry);
  for (const std::uintmax_t left : {std::uintmax_t{0}, std::uintmax_t{83}, size - 1}) {
    std::filesystem::resize_file(entry, left);
    EXPECT_EQ(bounds().max, glm::dvec3(2)) << left;
    EXPECT_EQ(std::filesystem::file_size(entry), size);
  }
  // What is nothing is kept too.
  const Model nothing = parseCsg("hull();", "a.csg", folder_.path(), options_);
  EXPECT_TRUE(nothing.leaves.empty());
  EXPECT_EQ(fileCount(options_.cacheFolder), 2u);
}

TEST_F(Files, aMeshCutShortIsTheMachinesFault) {
  options_.openscad = write("openscad", "#!/bin/sh\nprintf junk >\"$4\"\n");
  std::filesystem::permissions(options_.openscad, std::filesystem::perms::owner_all);
  EXPECT_EQ(failureOf([&] { parseCsg("hull() { cube(1); }", "a.csg", folder_.path(), options_); }, ExitCode::Machine),
            "a.csg:1: openscad on hull wrote no whole mesh");
}

TEST_F(Files, textWithQuotesAndBackslashes) {
  SKIP_WITHOUT_OPENSCAD();
  const std::string csg = csgBy("linear_extrude(2) text(\"a\\\"b\\\\ü)\", size = 10); text(\"I\");");
  const Model model = parseCsg(csg, "a.csg", folder_.path(), options_);
  ASSERT_EQ(model.leaves.size(), 2u);
  const std::vector<FloatTriangle> theirs = exportedBy("linear_extrude(2) text(\"a\\\"b\\\\ü)\", size = 10);");
  EXPECT_NEAR(volumeOf(trianglesOf(*model.leaves[0].mesh)), volumeOf(theirs), 1e-6 * volumeOf(theirs));
  EXPECT_EQ(pointsOf(trianglesOf(*model.leaves[0].mesh)), pointsOf(theirs));
  EXPECT_EQ(openEdgeCount(trianglesOf(*model.leaves[0].mesh)), 0u);
}

TEST_F(Files, withoutOpenscadOneClearLine) {
  options_.openscad = "no-such-openscad";
  EXPECT_EQ(failureOf([&] { parseCsg("text(text=\"a\");", "a.csg", ".", options_); }, ExitCode::Machine),
            "no-such-openscad: not found; the program openscad is needed for parts of this model");
  EXPECT_EQ(parseCsg("cube(1);", "a.csg", ".", options_).leaves.size(), 1u);
}

std::string shapeOf(const Model& model) {
  std::vector<std::string> texts;
  for (const Node& node : model.nodes) {
    std::string text;
    if (node.operation == Operation::Leaf) text = fmt::format("{}", node.leaf);
    const char sign = node.operation == Operation::Union ? '+' : node.operation == Operation::Difference ? '-' : '&';
    for (std::uint32_t c = 0; c < node.childCount; ++c) text += (c == 0 ? "(" : std::string(1, sign)) + texts[model.childIndices[node.firstChild + c]];
    texts.push_back(node.childCount ? text + ")" : text);
  }
  return texts[model.root];
}

TEST_F(Files, expressionsOverMeshes) {
  const std::string path = write("t.off", kTetrahedron);
  const std::vector<std::string> paths(30, path);
  EXPECT_EQ(shapeOf(readMeshes({path, path, path}, "A - B + C")), "((0-1)+2)");
  EXPECT_EQ(shapeOf(readMeshes({path, path, path}, "A-B&C")), "(0-(1&2))");
  EXPECT_EQ(shapeOf(readMeshes({path, path, path}, " ( A | B ) * C ")), "((0+1)&2)");
  EXPECT_EQ(shapeOf(readMeshes({path, path, path}, "A-(B-C)")), "(0-(1-2))");
  EXPECT_EQ(readMeshes(paths, "").leaves.size(), 30u);
  EXPECT_EQ(readMeshes(paths, "Z - M27 - M1").leaves.size(), 3u);
  const Model twice = readMeshes({path, path}, "A - A - B");
  EXPECT_EQ(twice.leaves[0].mesh, twice.leaves[1].mesh);
  for (const char* bad : {"A -", "A B", "(A", "A)", "D", "a", "A ^ B", "M31", "M0", "()", "A - - B", "\xc3"}) {
    const std::vector<std::string> few = std::string(bad)[0] == 'M' ? paths : std::vector<std::string>{path, path, path};
    EXPECT_NE(failureOf([&] { readMeshes(few, bad); }, ExitCode::Usage), "no failure") << bad;
  }
  const auto place = [&](const char* text) { return failureOf([&] { readMeshes({path, path}, text); }, ExitCode::Usage).substr(0, 24); };
  EXPECT_EQ(place("A ^ B"), "expression: character 3:");
  EXPECT_EQ(place("A )"), "expression: character 3:");
  EXPECT_EQ(place("A - C"), "expression: character 5:");
  EXPECT_EQ(place("A - M7"), "expression: character 5:");
  EXPECT_EQ(shapeOf(readMeshes({path}, std::string(100000, '(') + "A" + std::string(100000, ')'))), "0");
}

// A plate of cylinders as openscad writes it, 170 bytes a leaf.
std::string plate(int count) {
  std::string text = "difference() {\n\tcube(size = [100, 100, 5], center = false);\n";
  for (int i = 0; i < count; ++i) {
    text += fmt::format("\tmultmatrix([[1, 0, 0, {:g}], [0, 1, 0, {:g}], [0, 0, 1, -1], [0, 0, 0, 1]]) {{\n\t\t"
                        "cylinder($fn = 32, $fa = 12, $fs = 2, h = 7, r1 = 0.8, r2 = 0.8, center = false);\n\t}}\n", i % 317 * 3.1, i / 317 * 3.3);
  }
  return text + "}\n";
}

// One mesh serves all leaves of a shape, however many there are.
TEST(Plates, shareOneMesh) {
  for (const int holes : {1000, 100000}) {
    const Model model = parse(plate(holes));
    EXPECT_EQ(model.leaves.size(), static_cast<std::size_t>(holes) + 1);
    EXPECT_EQ(model.leaves[1].mesh, model.leaves.back().mesh);
  }
}

}  // namespace
}  // namespace copeel::csg
