#include "apps/bench/stand_ins.h"

#include <fmt/format.h>

#include "core/formats/read_mesh.h"

namespace copeel::bench {
namespace {

constexpr unsigned kShellColumns = 28, kShellRows = 18;
constexpr unsigned kBunnyColumns = 264, kBunnyRows = 132;   // 69,692 triangles
constexpr unsigned kRowColumns = 50, kRowRows = 50;
constexpr int kJoints = 80;
constexpr int kHairballHairs = 1040;                        // 998,400 triangles
constexpr int kDeepHairs = 200;                             // 192,000

BenchScene titled(BenchScene scene, std::string title) {
  scene.title = std::move(title);
  return scene;
}

}  // namespace

Mesh StandIns::read(const char* name) const { return readMesh(folder_ + "/models/" + name); }

BenchScene StandIns::crank() const {
  if (areFiles()) return titled(copies(read("crank_10k.ply"), 1, "crank"), "crank_10k.ply, nothing coplanar");
  return titled(copies(bumpySphere(100, 50), 1, "sphere"), "a generated bumpy sphere of 10,000 triangles, nothing coplanar");
}

BenchScene StandIns::fandisk(std::size_t copyCount) const {
  if (areFiles()) return titled(copies(read("fandisk_1k4.ply"), copyCount, "fandisk"), "coincident copies of fandisk_1k4.ply");
  return titled(copies(shells(2, kShellColumns, kShellRows), copyCount, "shells"), "coincident copies of two generated shells of 2,000 triangles together");
}

std::vector<BenchScene> StandIns::deep() const {
  std::vector<BenchScene> scenes;
  if (areFiles()) {
    scenes.push_back(titled(copies(read("engine_2cylinder_110k.ply"), 1, "engine"), "engine_2cylinder_110k.ply"));
    scenes.push_back(titled(copies(bench::hairball(kDeepHairs, kJoints), 1, "hairball"), "a generated ball of 192,000 triangles"));
    return scenes;
  }
  for (const unsigned count : {1u, 2u, 4u, 8u}) scenes.push_back(titled(copies(shells(count, kShellColumns, kShellRows), 1, fmt::format("shells-{}", count)), "generated shells in one another"));
  return scenes;
}

BenchScene StandIns::dragons() const {
  if (areFiles()) return titled(threeInARow(read("dragon_11k.ply")), "three dragons (dragon_11k.ply) in a row along the view");
  return titled(threeInARow(shells(2, kRowColumns, kRowRows)), "three generated balls, a shell in a shell each, in a row along the view");
}

BenchScene StandIns::bunny(std::size_t copyCount) const {
  const std::string number = copyCount == 1 ? "" : fmt::format("{} coincident copies of ", copyCount);
  if (areFiles()) return titled(copies(read("bunny_69k.ply"), copyCount, fmt::format("bunny x{}", copyCount)), number + "bunny_69k.ply");
  return titled(copies(bumpySphere(kBunnyColumns, kBunnyRows), copyCount, fmt::format("sphere x{}", copyCount)), number + "a generated bumpy sphere of 69,692 triangles, for the bunny");
}

BenchScene StandIns::peer() const { return areFiles() ? bunny(1) : copies(shells(1, 100, 100), 1, "shell"); }

BenchScene StandIns::hairball() const { return titled(copies(bench::hairball(kHairballHairs, kJoints), 1, "hairball"), "a generated ball of 998,400 triangles"); }

}  // namespace copeel::bench
