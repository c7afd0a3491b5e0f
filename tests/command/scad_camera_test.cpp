// A .scad that sets $vpt, $vpr or $vpd is seen as openscad sees it: the picture is the one that --camera gives for the same numbers.
#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/command/program.h"

namespace copeel {
namespace {

class ScadCamera : public ProgramTest {
 protected:
  void SetUp() override {
    if (std::system("command -v openscad >/dev/null") != 0) GTEST_SKIP() << "no openscad";
    ProgramTest::SetUp();
  }

  // The picture of the source alone, and of the plain cube with the options that should be the same.
  void expectSame(const std::string& variables, std::vector<std::string> own, std::vector<std::string> equal) {
    SCOPED_TRACE(variables);
    write("own.scad", variables + "cube([10, 20, 30]);\n");
    write("equal.scad", "cube([10, 20, 30]);\n");
    own.insert(own.begin(), {"csg", "own.scad"});
    equal.insert(equal.begin(), {"csg", "equal.scad"});
    const Outcome outcome = run(own);
    ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
    EXPECT_EQ(outcome.standardError, "");
    ASSERT_EQ(run(equal).exitCode, 0);
    EXPECT_EQ(contentOf(folder_ / "own.png"), contentOf(folder_ / "equal.png"));
  }
};

TEST_F(ScadCamera, VariablesReplaceNumbers) {
  expectSame("$vpt = [5, 10, 15]; $vpr = [60, 0, 120]; $vpd = 90;\n", {}, {"--camera", "5,10,15,60,0,120,90"});
  expectSame("$vpd = 300;\n", {}, {"--camera", "0,0,0,55,0,25,300"});
  expectSame("$vpr = [0, 0, 0];\n", {"--viewall"}, {"--camera", "0,0,0,0,0,0,140"});
  expectSame("$vpt = [5, 10, 15];\n", {"--camera", "1,2,3,40,0,30,120"}, {"--camera", "5,10,15,40,0,30,120"});
}

TEST_F(ScadCamera, WhatIsNotSetChangesNothing) { expectSame("// $vpd == 3\nx = $vpd;\n", {}, {}); }

}  // namespace
}  // namespace copeel
