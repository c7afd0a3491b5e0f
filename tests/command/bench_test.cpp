// copeel bench and the table of methods from outside: small runs whose counts are known beforehand.
#include <filesystem>
#include <regex>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/command/program.h"

namespace copeel {
namespace {

using Bench = ProgramTest;
using Json = nlohmann::json;

bool hasMethod(const std::string& listed, const std::string& name) {
  for (const auto& method : Json::parse(listed)) {
    if (method["name"] == name) return true;
  }
  return false;
}

std::size_t methodsOf(const std::string& backend, const std::string& listed) {
  std::size_t count = 0;
  for (const auto& method : Json::parse(listed)) count += method["backend"] == backend;
  return count;
}

constexpr const char* kCube =
    "OFF\n8 12 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n3 0 2 1\n3 0 3 2\n3 4 5 6\n3 4 6 7\n3 0 1 5\n3 0 5 4\n3 1 2 6\n3 1 6 5\n3 2 3 7\n3 2 7 6\n3 3 0 4\n3 3 4 7\n";
constexpr const char* kTrianglePly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

#define NEEDS_GL() \
  if (!hasMethod(run({"methods", "--json"}).standardOutput, "ll")) GTEST_SKIP() << "no gl back end in this build"

std::vector<Json> entriesOf(const Json& list, const std::string& method) {
  std::vector<Json> found;
  for (const Json& entry : list) {
    if (entry["method"] == method) found.push_back(entry);
  }
  return found;
}

// One run for all that is asked of a report: of three coplanar squares each pixel off their seams has three fragments at one depth.
TEST_F(Bench, ReportIsWholeAndItsCountsAreRight) {
  NEEDS_GL();
  const Outcome outcome = run({"bench", "--parts", "scenes,coplanarity,depth,culling,table2011", "--scene", "cut,copies", "--copies", "3", "--methods", "ll,f2b,tile", "--sizes", "64,48",
                               "--frames", "1", "--seconds", "100000", "--report", "report", "--quiet"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  const Json json = Json::parse(contentOf(folder_ / "report/bench.json"));
  ASSERT_EQ(json["scenes"].size(), 2u);
  for (const Json& scene : json["scenes"]) {
    for (const char* robust : {"ll", "tile"}) {
      const Json entry = entriesOf(scene["methods"], robust).at(0);
      EXPECT_EQ(entry["rh"], 1.0);
      EXPECT_EQ(entry["wrong_pixels"], 0) << scene["name"] << " " << robust;
      EXPECT_EQ(entry["depth_error"].get<double>() < 1e-5, true) << entry["depth_error"];
    }
    const Json f2b = entriesOf(scene["methods"], "f2b").at(0);
    EXPECT_NEAR(f2b["rh"].get<double>(), 1.0 / 3, 1e-9);
    EXPECT_GT(f2b["wrong_pixels"], 100);
  }
  EXPECT_EQ(entriesOf(json["scenes"][0]["methods"], "f2b").at(0)["passes"], 2);
  for (const Json& entry : entriesOf(json["over_coplanarity"], "f2b")) EXPECT_NEAR(entry["rh"].get<double>(), 1 / entry["parameter"].get<double>(), 1e-9);
  for (const Json& entry : entriesOf(json["over_depth_complexity"], "f2b")) EXPECT_EQ(entry["depth_complexity_max"], 2 * entry["parameter"].get<int>());
  ASSERT_EQ(json["culling"].size(), 6u);
  const auto plain = json["culling"][0]["objects_drawn"].get<std::vector<int>>(), culled = json["culling"][1]["objects_drawn"].get<std::vector<int>>();
  EXPECT_EQ(json["culling"][0]["rh"], json["culling"][1]["rh"]);
  EXPECT_EQ(plain, std::vector<int>(plain.size(), 3));
  EXPECT_LT(culled.back(), 3);
  EXPECT_EQ(json["table_2011"].size(), 12u);
  for (const Json& limit : json["limits"]) EXPECT_EQ(limit["holds"], true) << limit;

  const std::string html = contentOf(folder_ / "report/index.html");
  const std::regex reference("src=\"([^\"]+)\"");
  std::set<std::string> named;
  for (std::sregex_iterator it(html.begin(), html.end(), reference), end; it != end; ++it) named.insert((*it)[1]);
  EXPECT_GE(named.size(), 12u);   // two pictures of two scenes of three methods
  for (const std::string& file : named) EXPECT_TRUE(std::filesystem::exists(folder_ / "report" / file)) << file;
}

// Counts do not depend on the size of the picture, as long as it shows the middle.
TEST_F(Bench, TableOf2011) {
  NEEDS_GL();
  const Outcome outcome = run({"bench", "--table", "2011", "--sizes", "64,48", "--frames", "1"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  for (const char* row : {"f2b +1 +8 +8 +100.0 +100.0 +9 +8 ", "f2b +4 +8 +8 +25.0 +25.0 +9 +8 ", "f2b +8 +8 +8 +12.5 +12.5 +9 +8 ", "f2b +12 +8 +8 +8.3 +8.3 +9 +8 ",
                          "f2b-zf +1 +8 +8 +100.0 +100.0 +17 +17 ", "f2b-zf +4 +32 +32 +100.0 +100.0 +65 +65 ", "f2b-zf +8 +64 +64 +100.0 +100.0 +129 +129 ",
                          "f2b-zf +12 +96 +96 +100.0 +100.0 +193 +193 ", "f2b-kb-zf +1 +8 +8 +100.0 +100.0 +17 +16 ", "f2b-kb-zf +4 +32 +32 +100.0 +100.0 +17 +16 ",
                          "f2b-kb-zf +8 +64 +64 +100.0 +100.0 +17 +16 ", "f2b-kb-zf +12 +64 +64 +66.7 +66.6 +17 +16 "}) {
    EXPECT_TRUE(std::regex_search(outcome.standardOutput, std::regex(std::string("\n") + row))) << row << "\n" << outcome.standardOutput;
  }
}

// A mesh and a camera of one's own: a cube seen along an axis has two layers.
TEST_F(Bench, TableOf2011OfAMesh) {
  NEEDS_GL();
  write("cube.off", kCube);
  const Outcome outcome = run({"bench", "--table", "2011", "--scene", "cube.off", "--camera", "0.5,0.5,0.5,0,0,0,6", "--sizes", "32,24", "--frames", "1", "--json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  const double accuracy[] = {100, 25, 12.5, 100 / 12.0};
  const std::vector<Json> f2b = entriesOf(Json::parse(outcome.standardOutput), "f2b");
  ASSERT_EQ(f2b.size(), 4u);
  for (std::size_t i = 0; i < f2b.size(); ++i) {
    EXPECT_EQ(f2b[i]["peeled"], 2);
    EXPECT_NEAR(f2b[i]["accuracy"].get<double>(), accuracy[i], 1e-9);
  }
}

// Formulas that are exact are met by the run; those that say "at most", "about" or "more" are bounds.
TEST_F(Bench, TableOf2013IsAsItsFormulasSay) {
  NEEDS_GL();
  const Outcome outcome = run({"bench", "--table", "2013", "--sizes", "32,24", "--frames", "1", "--json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  const Json table = Json::parse(outcome.standardOutput);
  EXPECT_EQ(table["methods"].size(), methodsOf("gl", run({"methods", "--json"}).standardOutput));
  const double halfOfTheBytes = 0.5 * 400 / (4 * 32 * 24);   // words a pixel that counters of a few hundred bytes make
  for (const Json& row : table["methods"]) {
    const std::string formula = row["passes"]["formula"];
    const bool isBound = formula.starts_with("at most") || formula.find("look") != std::string::npos;
    if (isBound) {
      EXPECT_LE(row["passes"]["measured"].get<double>(), row["passes"]["expected"].get<double>() + (row["method"] == "auto" ? 2 : 0)) << row;
    } else {
      EXPECT_EQ(row["passes"]["measured"].get<double>(), row["passes"]["expected"].get<double>()) << row;
    }
    EXPECT_NEAR(row["rh"]["measured"].get<double>(), row["rh"]["expected"].get<double>(), 1e-9) << row;
    const Json& words = row["words_per_pixel"];
    if (!words["expected"].is_null()) {
      EXPECT_NEAR(words["measured"].get<double>(), words["expected"].get<double>(), halfOfTheBytes) << row;
    }
  }
}

TEST_F(Bench, BackEndsAreChosen) {
  const Outcome outcome = run({"bench", "--backend", "cpu", "--scene", "cut", "--sizes", "32,24", "--frames", "1", "--report", "r", "--quiet"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  const Json json = Json::parse(contentOf(folder_ / "r/bench.json"));
  EXPECT_EQ(json["scenes"][0]["methods"].size(), methodsOf("cpu", run({"methods", "--json"}).standardOutput));
  for (const Json& entry : json["scenes"][0]["methods"]) EXPECT_EQ(entry["backend"], "cpu");
  EXPECT_TRUE(json["over_resolution"].empty());   // with a scene, that scene alone
}

// No method goes without a word: it was measured, or its entry says why not.
TEST_F(Bench, WhatTakesTooLongIsNamed) {
  NEEDS_GL();
  const Outcome outcome = run({"bench", "--scene", "copies", "--copies", "12", "--seconds", "1", "--report", "r", "--quiet"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  const Json json = Json::parse(contentOf(folder_ / "r/bench.json"));
  int leftOut = 0;
  for (const Json& entry : json["scenes"][0]["methods"]) {
    EXPECT_NE(entry.contains("ms"), entry.contains("left_out")) << entry;
    leftOut += entry.contains("left_out");
  }
  EXPECT_GT(leftOut, 0);
  EXPECT_NE(outcome.standardOutput.find("left out"), std::string::npos);
}

// The rasterizer's depths of one plane, tessellated in three ways, differ.
TEST_F(Bench, HardwareDepthStandsBesideOurs) {
  NEEDS_GL();
  const Outcome outcome = run({"bench", "--scene", "cut", "--methods", "ll", "--sizes", "64,48", "--frames", "1", "--seconds", "100000", "--report", "r", "--quiet"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  const Json entries = Json::parse(contentOf(folder_ / "r/bench.json"))["scenes"][0]["methods"];
  const Json planes = entriesOf(entries, "ll").at(0), hardware = entriesOf(entries, "ll (hardware depth)").at(0);
  EXPECT_EQ(planes["cp"], 1.0);
  EXPECT_LT(hardware["cp"].get<double>(), 1.0);
  EXPECT_EQ(planes["wrong_pixels"], 0);
  EXPECT_GT(hardware["wrong_pixels"], 0);
  EXPECT_EQ(hardware["fragments"], planes["fragments"]);
}

TEST_F(Bench, FiguresTakeTheMeshesOfAFolder) {
  std::filesystem::create_directories(folder_ / "data/models");
  const std::vector<std::string> words = {"bench", "--parts", "coplanarity", "--methods", "tile", "--data", "data", "--sizes", "32,24", "--frames", "1", "--report", "r", "--quiet"};
  expectFailure(run(words), 1);
  write("data/models/fandisk_1k4.ply", kTrianglePly);
  const Outcome outcome = run(words);
  ASSERT_EQ(outcome.exitCode, 0) << outcome.standardError;
  const Json json = Json::parse(contentOf(folder_ / "r/bench.json"));
  EXPECT_NE(json["stand_ins"]["coplanarity"].get<std::string>().find("fandisk_1k4.ply"), std::string::npos);
  EXPECT_EQ(json["over_coplanarity"].size(), 5u);
  for (const Json& entry : json["over_coplanarity"]) EXPECT_EQ(entry["triangles"], entry["parameter"]);
}

TEST_F(Bench, RefusesWithOneLine) {
  using Words = std::vector<std::string>;
  for (const Words& words : std::vector<Words>{{"bench"}, {"bench", "--table", "2012"}, {"bench", "--report", "r", "--methods", "nonsense"}, {"bench", "--report", "r", "--methods", "ll+"},
                                               {"bench", "--report", "r", "--sizes", "100"}, {"bench", "--report", "r", "--frames", "0"}, {"methods", "--json", "--markdown"},
                                               {"bench", "--report", "r", "--parts", "scenes,nonsense"}, {"bench", "--report", "r", "--backend", "gpu"},
                                               {"bench", "--report", "r", "--backend", "cpu", "--methods", "f2b"}, {"bench", "--report", "r", "--depth-source", "guess"},
                                               {"bench", "--report", "r", "--camera", "1,2"}, {"bench", "--report", "r", "--seconds", "0"}, {"bench", "--report", "r", "--json"},
                                               {"bench", "--table", "2013", "--scene", "cut"}, {"bench", "--table", "2013", "--json", "--markdown"}}) {
    expectFailure(run(words), 2);
  }
  expectFailure(run({"bench", "--report", "r", "--methods", "tile", "--scene", "no_such_mesh.ply", "--no-peer"}), 1);
}

// README's table is what the program prints; a build without the gl back end has fewer lines.
TEST_F(Bench, ReadmeHasTheTableOfMethods) {
  NEEDS_GL();
  const std::string readme = contentOf(COPEEL_README), begin = "<!-- methods: made by `copeel methods --markdown` -->\n";
  const std::size_t from = readme.find(begin), to = readme.find("<!-- end of methods -->");
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  EXPECT_EQ(readme.substr(from + begin.size(), to - from - begin.size()), run({"methods", "--markdown"}).standardOutput);
}

// The same of the table of 2013, less the times, the last column; and less what may differ from machine to machine: auto.
TEST_F(Bench, ReadmeHasTheTableOf2013) {
  NEEDS_GL();
  const std::regex time("\\| [0-9.]* \\|\n"), choice("\\| `auto` [^\n]*\n");
  const auto lessTimes = [&](const std::string& text) { return std::regex_replace(std::regex_replace(text, time, "|\n"), choice, ""); };
  const std::string readme = contentOf(COPEEL_README), begin = "<!-- table of 2013: made by `copeel bench --table 2013 --sizes 64,48 --markdown` -->\n";
  const std::size_t from = readme.find(begin), to = readme.find("<!-- end of the table of 2013 -->");
  ASSERT_NE(from, std::string::npos);
  ASSERT_NE(to, std::string::npos);
  const Outcome outcome = run({"bench", "--table", "2013", "--sizes", "64,48", "--frames", "1", "--markdown"});
  EXPECT_EQ(lessTimes(readme.substr(from + begin.size(), to - from - begin.size())), lessTimes(outcome.standardOutput));
}

}  // namespace
}  // namespace copeel
