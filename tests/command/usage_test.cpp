// What the command line accepts and refuses: the exit code, one line, and no file left behind.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/command/program.h"

namespace copeel {
namespace {

using Usage = ProgramTest;
using Words = std::vector<std::string>;

TEST_F(Usage, HelpAndVersionSucceed) {
  for (const Words& words : std::vector<Words>{{"--help"}, {"csg", "--help"}, {"methods", "--help"}, {"oit", "--help"}, {"--version"}}) {
    const Outcome outcome = run(words);
    EXPECT_EQ(outcome.exitCode, 0) << words[0];
    EXPECT_FALSE(outcome.standardOutput.empty());
    EXPECT_TRUE(outcome.standardError.empty());
  }
}

TEST_F(Usage, RefusedWithOneLine) {
  const std::vector<Words> cases = {
      {},
      {"nonsense"},
      {"csg"},
      {"csg", "part.csg", "--nonsense"},
      {"csg", "part.csg", "--imgsize", "100"},
      {"csg", "part.csg", "--imgsize", "0,100"},
      {"csg", "part.csg", "--imgsize", "100,16385"},
      {"csg", "part.csg", "--imgsize", "1e2,100"},
      {"csg", "part.csg", "--imgsize", "99999999999,100"},
      {"csg", "part.csg", "--camera", "1,2,3"},
      {"csg", "part.csg", "--camera", "1,2,3,4,5,x"},
      {"csg", "part.csg", "--camera", "1,2,3,4,5,nan"},
      {"csg", "part.csg", "--camera", "0,0,0,0,0,0,0"},
      {"csg", "part.csg", "--camera", "1,1,1,1,1,1"},
      {"csg", "part.csg", "--projection", "q"},
      {"csg", "part.csg", "--backend", "cuda"},
      {"csg", "part.csg", "--backend", "cpu|gl"},
      {"csg", "part.csg", "--backend", "cpu", "--method", "ll"},
      {"csg", "part.csg", "--backend", "gl", "--method", "tile"},
      {"csg", "part.csg", "--method", "tile+cull"},
      {"csg", "part.csg", "--method", "ll+"},
      {"csg", "part.csg", "--buffer-length", "0"},
      {"csg", "part.csg", "--depth-source", "float"},
      {"csg", "part.csg", "--method", "nonsense"},
      {"csg", "part.csg", "--threads", "0"},
      {"csg", "part.csg", "--threads", "1.5"},
      {"csg", "part.csg", "--memory", "lots"},
      {"csg", "part.csg", "--memory", "-5M"},
      {"csg", "part.csg", "--samples", "0"},
      {"csg", "part.csg", "--frames", "0"},
      {"csg", "part.csg", "--coplanar-tolerance", "-1"},
      {"csg", "part.csg", "--coplanar-tolerance", "inf"},
      {"csg", "part.csg", "--section", "w=1"},
      {"csg", "part.csg", "--section", "x="},
      {"csg", "part.csg", "--section", "x=1", "--method", "zbuffer"},
      {"csg", "part.csg", "--inside", "even"},
      {"csg", "part.csg", "--colorscheme", "nonsense"},
      {"csg", "part.csg", "--background", "white"},
      {"csg", "part.csg", "--background", "#12345g"},
      {"csg", "part.csg", "--shading", "phong"},
      {"csg", "part.csg", "--light", "1,2"},
      {"csg", "part.csg", "--light", "0,0,0"},
      {"csg", "part.csg", "--light", "0,0,0,2"},
      {"csg", "part.csg", "--light", "1,1,1,-1"},
      {"csg", "part.csg", "--light", "1,1,1,1e7"},
      {"csg", "part.csg", "--light", "1,1,1,1,1"},
      {"csg", "part.csg", "--light", "left"},
      {"csg", "part.csg", "--light", "1,inf,1"},
      {"csg", "part.csg", "--light", "0,0,1", "--shading", "none"},
      {"csg", "part.csg", "--depth-source", "hardware"},
      {"csg", "part.csg", "--depth-source", "hardware", "--method", "zbuffer"},
      {"csg", "part.csg", "-D", "x=1"},
      {"csg", "part.scad", "-D", "x="},
      {"csg", "part.scad", "-D", "x= ;"},
      {"csg", "part.csg", "--expr", "A"},
      {"csg", "part.csg", "part.csg"},
      {"csg", "part.csg", "-o", "part.jpg"},
      {"csg", "part.csg", "-o", "a.png", "--depth", "./a.png"},
      {"csg", "part.csg", "--depth", "a.pfm", "--stats", "a.pfm"},
      {"csg", "part.csg", "--stats", "part.csg"},
      {"csg", "part.csg", "--stats", "-", "-o", "-"},
      {"csg", "a.stl:alpha=2"},
      {"csg", "a.stl:color=red"},
      {"csg", "a.stl:alpha=1,shine=3"},
      {"oit"},
      {"oit", "a.stl:alpha=2"},
      {"oit", "a.stl:color=red"},
      {"oit", "a.stl", "--alpha", "-0.1"},
      {"oit", "a.stl", "--alpha", "half"},
      {"oit", "a.stl", "--color", "red"},
      {"oit", "part.csg", "--shading", "none", "--light", "0,0,1"},
      {"oit", "a.stl", "--expr", "A"},
      {"oit", "a.stl", "--method", "nonsense"},
      {"oit", "part.csg", "--layers", "part.csg"},
      {"oit", "part.csg", "--layers", "l.pgm", "--coplanar", "l.pgm"},
  };
  for (const Words& words : cases) {
    SCOPED_TRACE(::testing::PrintToString(words));
    expectFailure(run(words), 2);
  }
  EXPECT_EQ(files(), Words{"part.csg"});
}

TEST_F(Usage, WhatIsNotBuiltSaysSo) {
  for (const char* command : {"wireframe", "collide", "coplanar", "view", "validate"}) {
    const Outcome outcome = run({command, "a.stl", "--alpha", "0.5"});
    expectFailure(outcome, 3);
    EXPECT_NE(outcome.standardError.find("not built in this version"), std::string::npos);
  }
}

TEST_F(Usage, MethodsAsTableAndJson) {
  const Outcome table = run({"methods"});
  EXPECT_EQ(table.exitCode, 0);
  EXPECT_NE(table.standardOutput.find("tile"), std::string::npos);
  const auto list = nlohmann::json::parse(run({"methods", "--json"}).standardOutput);
  ASSERT_TRUE(list.is_array());
  for (const auto& method : list) {
    for (const char* key : {"name", "backend", "robust", "rh", "passes", "memory", "paper_words", "title", "source"}) EXPECT_TRUE(method.contains(key)) << key;
  }
}

TEST_F(Usage, MoreThreadsThanCoresAreNothingToWarnOf) {
  const Outcome outcome = run({"csg", "part.csg", "--imgsize", "64,48", "--threads", "67", "-o", "a.png"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_TRUE(outcome.standardError.empty()) << outcome.standardError;
}

TEST_F(Usage, EveryOptionTogether) {
  const Outcome outcome = run({"csg", "part.csg", "-o", "a.png", "--imgsize", "64, 48", "--camera=0,0,0,+55,0,2.5e1,140", "--viewall", "--autocenter",
                               "--projection", "ortho", "--backend", "cpu", "--method", "tile", "--threads", "2", "--memory", kAmpleMemory, "--samples", "4",
                               "--coplanar-tolerance", "1e-7", "--section", "x=10", "--section", "-z=-5", "--inside", "positive", "--colorscheme",
                               "tomorrow night", "--background", "#fff", "--shading", "none", "--depth", "a.pfm", "--ids", "a.pgm", "--stats", "a.json",
                               "--frames", "3", "--quiet"});
  EXPECT_EQ(outcome.exitCode, 0) << outcome.standardError;
  EXPECT_TRUE(outcome.standardError.empty()) << outcome.standardError;
  EXPECT_EQ(files(), (Words{"a.json", "a.pfm", "a.pgm", "a.png", "part.csg"}));
}

}  // namespace
}  // namespace copeel
