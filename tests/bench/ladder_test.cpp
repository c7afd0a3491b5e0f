// The ladder on its first rung: it ends well, and its JSON holds what readers of it look for.
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bench/generated_scenes.h"
#include "bench/process.h"
#include "bench/table.h"
#include "bench/work_folder.h"

namespace copeel::bench {
namespace {

TEST(Ladder, QuickRunWritesAllKeys) {
  if (!isInstalled("openscad")) GTEST_SKIP() << "openscad turns the rungs into .csg";
  const WorkFolder work;
  const std::string file = (work.path() / "ladder.json").string();
  const ProcessRun run = runProcess({COPEEL_LADDER, "--rungs", "a", "--quick", "--json", file}, {});
  ASSERT_EQ(run.exitCode, 0) << run.errors;

  const auto json = nlohmann::json::parse(std::ifstream(file));
  for (const char* key : {"machine", "threads", "width", "height", "rungs", "left_out", "scaling", "checks"}) EXPECT_TRUE(json.contains(key)) << key;
  for (const char* key : {"processor", "cores", "simd"}) EXPECT_TRUE(json["machine"].contains(key)) << key;
  ASSERT_EQ(json["rungs"].size(), 1u) << run.errors;
  const auto& rung = json["rungs"][0];
  for (const char* key : {"name", "triangles", "fragments", "zbuffer_ms", "csg_ms", "ratio", "prepare_ms", "load_ms", "process", "bytes_per_triangle"}) {
    EXPECT_TRUE(rung.contains(key)) << key;
  }
  EXPECT_EQ(rung["triangles"], 24);
  EXPECT_GT(rung["process"]["copeel_csg"]["peak_bytes"], 0);
}

TEST(Ladder, UnknownRungIsNamed) {
  const ProcessRun run = runProcess({COPEEL_LADDER, "--rungs", "nosuch", "--quick"}, {});
  EXPECT_EQ(run.exitCode, 2);
  EXPECT_NE(run.errors.find("nosuch"), std::string::npos);
}

TEST(GeneratedPlates, HaveAsManyHolesAsAsked) {
  for (int holes : {1, 100, 1000, 10'000, 100'000, 7}) {
    const PlateOfHoles plate = plateOf(holes, Sight::Open);
    EXPECT_EQ(plate.columns * plate.rows, holes);
  }
  const std::string csg = toCsg(plateOf(100, Sight::Boxed));
  std::size_t cylinders = 0;
  for (std::size_t at = csg.find("cylinder"); at != std::string::npos; at = csg.find("cylinder", at + 1)) ++cylinders;
  EXPECT_EQ(cylinders, 100u);
}

TEST(Tables, NumbersKeepThreeDigits) {
  EXPECT_EQ(number(1.234), "1.23");
  EXPECT_EQ(number(9.999), "10.0");
  EXPECT_EQ(number(12.34), "12.3");
  EXPECT_EQ(number(123.4), "123");
  EXPECT_EQ(number(12345.6), "12,346");
  EXPECT_EQ(number(0), "");
  EXPECT_EQ(count(1'234'567), "1,234,567");
}

}  // namespace
}  // namespace copeel::bench
