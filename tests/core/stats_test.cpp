// The names that scripts depend on.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/metrics/stats.h"

namespace copeel {
namespace {

TEST(Stats, holdsEveryNameOfTheDesign) {
  Stats stats;
  stats.method = "tiles \"quoted\"\n\xff";
  stats.fragments = 4;
  stats.fragmentsCaptured = 3;
  stats.coveredPixels = 8;
  stats.coplanarPixels = 2;
  stats.memoryBytes = 1ull << 40;
  stats.loadMs = 1.5;
  const nlohmann::json json = nlohmann::json::parse(toJson(stats));
  for (const char* name : {"method", "backend", "width", "height", "triangles", "leaves", "plane_classes", "fragments",
                           "fragments_captured", "rh", "depth_complexity_max", "coplanar_pixels", "cp", "overflow",
                           "passes", "memory_bytes", "decided_exactly", "uncertain", "ms"}) {
    EXPECT_TRUE(json.contains(name)) << name;
  }
  for (const char* name : {"load", "prepare", "frame_median", "frame_min", "total"})
    EXPECT_TRUE(json["ms"].contains(name)) << name;
  EXPECT_EQ(json["rh"], 0.75);
  EXPECT_EQ(json["cp"], 0.25);
  EXPECT_EQ(json["memory_bytes"], 1ull << 40);
  EXPECT_EQ(json["ms"]["load"], 1.5);
}

}  // namespace
}  // namespace copeel
