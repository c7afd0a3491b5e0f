// The models measured beforehand with other tools (their README): same triangle counts, same answer to "closed", and loading within its time.
// Skipped where the folder is missing: the models' licences keep them out of this project.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>

#include "core/formats/read_mesh.h"

namespace copeel {
namespace {

struct Known {
  const char* name;
  std::size_t triangles;
  bool closed;
};
constexpr Known kKnown[] = {
    {"as1_assembly", 31358, true},
    {"beetle", 38656, false},
    {"cow_6k", 5804, true},
    {"crank_vhacd_parts", 31566, false},
    {"dragon_11k", 11102, true},
    {"duck_4k", 4212, true},
    {"engine_2cylinder_110k", 110336, false},
    {"menger3", 21598, true},
    {"suzanne_1k", 968, false},
    {"voxel_church_material", 179168, true},
};

TEST(SharedModels, areReadWhole) {
  if (!std::filesystem::exists(COPEEL_SHARED_MODELS)) GTEST_SKIP() << "no shared models";
  for (const Known& known : kKnown) {
    const Mesh mesh = readMesh(std::string(COPEEL_SHARED_MODELS "/") + known.name + ".ply");
    EXPECT_EQ(mesh.triangles.size(), known.triangles) << known.name;
    EXPECT_TRUE(mesh.singlePrecision) << known.name;
    EXPECT_EQ(statusOf(mesh).closed, known.closed) << known.name;
  }
}

double fastestMs(const std::string& path) {
  double fastest = 1e9;
  for (int i = 0; i < 5; ++i) {
    const auto start = std::chrono::steady_clock::now();
    readMesh(path);
    fastest =
        std::min(fastest, std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
  }
  return fastest;
}

// Generous by a factor of three or so: a busy machine is no failure, a reader that has become slow is.
TEST(SharedModels, loadQuickly) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
  GTEST_SKIP() << "times are for release builds";
#else
  const std::string dragon = COPEEL_SHARED_MODELS "/dragon_871k.ply",
                    rocker = COPEEL_SHARED_MODELS "/../csg/rocker-arm.off";
  if (!std::filesystem::exists(dragon) || !std::filesystem::exists(rocker)) GTEST_SKIP() << "no shared models";
  EXPECT_LT(fastestMs(dragon), 150);  // 871,306 triangles, binary PLY
  EXPECT_LT(fastestMs(rocker), 20);   // 20,088 triangles, OFF
#endif
}

}  // namespace
}  // namespace copeel
