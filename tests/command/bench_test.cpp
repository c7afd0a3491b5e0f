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
  const Outcome outcome = run({"bench", "--scene", "cut,copies", "--copies", "3", "--methods", "ll,f2b,tile", "--sizes", "64,48", "--frames", "1", "--report", "report", "--no-peer", "--quiet"});
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
  ASSERT_EQ(json["culling"].size(), 2u);
  const auto plain = json["culling"][0]["objects_drawn"].get<std::vector<int>>(), culled = json["culling"][1]["objects_drawn"].get<std::vector<int>>();
  EXPECT_EQ(json["culling"][0]["rh"], json["culling"][1]["rh"]);
  EXPECT_EQ(plain, std::vector<int>(plain.size(), 3));
  EXPECT_LT(culled.back(), 3);
  EXPECT_EQ(json["table_2011"].size(), 12u);

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

TEST_F(Bench, RefusesWithOneLine) {
  using Words = std::vector<std::string>;
  for (const Words& words : std::vector<Words>{{"bench"}, {"bench", "--table", "2012"}, {"bench", "--report", "r", "--methods", "nonsense"}, {"bench", "--report", "r", "--methods", "ll+"},
                                               {"bench", "--report", "r", "--sizes", "100"}, {"bench", "--report", "r", "--frames", "0"}, {"methods", "--json", "--markdown"}}) {
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

}  // namespace
}  // namespace copeel
