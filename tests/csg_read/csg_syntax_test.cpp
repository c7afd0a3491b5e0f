// The text of a .csg: what is understood, and what each kind of damage is answered with.
#include <chrono>

#include <gtest/gtest.h>

#include "apps/csg/read_model.h"
#include "core/error.h"

namespace copeel::csg {
namespace {

Model parse(const std::string& text) { return parseCsg(text, "part.csg", ".", ReadOptions{}); }

std::string failureOf(const std::string& text) {
  try {
    parse(text);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Input);
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos);
    return error.what();
  }
  return "";
}

TEST(CsgSyntax, readsATreeInPostOrder) {
  const Model model = parse("difference() {\n\tcube(size = [2, 2, 2], center = true);\n\tunion() { sphere($fn = 8, r = 1);\n cube(1); }\n}\n");
  ASSERT_EQ(model.nodes.size(), 5u);
  EXPECT_EQ(model.nodes[model.root].operation, Operation::Difference);
  EXPECT_EQ(model.leaves.size(), 3u);
  for (std::size_t i = 0; i < model.nodes.size(); ++i) {
    const Node& node = model.nodes[i];
    for (std::uint32_t c = 0; c < node.childCount; ++c) EXPECT_LT(model.childIndices[node.firstChild + c], i);
  }
}

TEST(CsgSyntax, leavesOfOneShapeShareOneMesh) {
  const Model model = parse("cube(size=[1,1,1],center=false); multmatrix([[1,0,0,5],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) { cube(size = [1.0, 1, 1]); }");
  ASSERT_EQ(model.leaves.size(), 2u);
  EXPECT_EQ(model.leaves[0].mesh, model.leaves[1].mesh);
  EXPECT_EQ(model.leaves[1].worldFromObject[3].x, 5);
}

TEST(CsgSyntax, aMillionLevelsOverflowNoStack) {
  std::string text;
  const int depth = 1000000;
  for (int i = 0; i < depth; ++i) text += "group(){";
  text += "cube(1);";
  for (int i = 0; i < depth; ++i) text += "}";
  EXPECT_EQ(parse(text).leaves.size(), 1u);
  EXPECT_NE(failureOf("cube(" + std::string(depth, '[')), "");
}

TEST(CsgSyntax, damageIsNamedWithItsLine) {
  EXPECT_EQ(failureOf("cube(1);\nfrob(2);\n"), "part.csg:2: unknown node 'frob'");
  EXPECT_EQ(failureOf("group() {\n cube(1);\n"), "part.csg:3: the file ends within group of line 1");
  EXPECT_EQ(failureOf("cube(1"), "part.csg:1: the file ends where ) should be");
  EXPECT_EQ(failureOf("cube(1;"), "part.csg:1: expected ), found ';'");
  EXPECT_EQ(failureOf("cube(1);}"), "part.csg:1: unexpected }");
  EXPECT_NE(failureOf("\xff\xfe\x01"), "");
  EXPECT_NE(failureOf("cube([1,2"), "");
  EXPECT_NE(failureOf("text(\"a"), "");
}

// A warning a line: each names its own, and 10^5 of them take no longer to number than to write (it was minutes).
TEST(CsgSyntax, aWarningOnEveryLine) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "multmatrix([[0,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(1);\n";
  const Model model = parse(text);
  ASSERT_EQ(model.warnings.size(), 100000u);
  EXPECT_EQ(model.warnings[0].substr(0, 11), "part.csg:1:");
  EXPECT_EQ(model.warnings[99999].substr(0, 16), "part.csg:100000:");
}

// The items of an inner vector are not the outer one's.
TEST(CsgSyntax, aRangeBeginsWithANumberOfItsOwn) {
  EXPECT_EQ(failureOf("polygon(points=[[[1] : 2]]);"), "part.csg:1: unexpected :");
  EXPECT_EQ(failureOf("polygon(points=[[1, 2 : 3]]);"), "part.csg:1: unexpected :");
}

TEST(CsgSyntax, byteOrderMarkCrlfAndCommentsAreTaken) {
  EXPECT_EQ(parse("\xEF\xBB\xBF// a part\r\ngroup() {\r\n\tcube(1);\r\n}\r\n/* end */").leaves.size(), 1u);
  EXPECT_EQ(parse("").root, kNoNode);
}

}  // namespace
}  // namespace copeel::csg
