// The k-buffers of the tile renderer: exactly the K nearest fragments of every pixel, whatever the tile does to find them; the others are counted.
#include <gtest/gtest.h>

#include <random>

#include <fmt/format.h>

#include "core/parallel.h"
#include "tests/support/coplanar_scenes.h"
#include "tests/support/stacks.h"

namespace copeel::test {
namespace {

constexpr std::uint32_t kLengths[] = {1, 2, 8, 32};

// Triangles any way through a box: most pixels have tens of fragments, neighbours other ones.
Mesh hay(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> within(-1, 1);
  Mesh mesh;
  for (int i = 0; i < 3 * count; ++i) mesh.vertices.emplace_back(within(random), within(random), within(random));
  for (unsigned i = 0; i < static_cast<unsigned>(count); ++i) mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  return mesh;
}

// Squares so close behind one another that keys cannot tell their order, in no order.
Scene closeSquares(double gap, int count) {
  std::vector<Object> objects;
  const MeshPointer square = share(quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}));
  for (int i = 0; i < count; ++i) objects.push_back({square, translation({0, 0, gap * (i * 7 % count)})});
  // What makes the range of depths long.
  objects.push_back({square, translation({0, 0, -100})});
  return Scene(std::move(objects));
}

// Blades through one line: at the line their depths are one.
Scene pencil(int count) {
  const MeshPointer blade = share(quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}));
  std::vector<Object> objects;
  for (int i = 0; i < count; ++i) objects.push_back({blade, rotation({180.0 * i / count, 0, 0})});
  return Scene(std::move(objects));
}

std::vector<NamedScene> nearestScenes() {
  std::vector<NamedScene> scenes = coplanarScenes();
  const View view = lookAt({3, 2, 4}, {0, 0, 0}, 70, 50, 0.012);
  scenes.push_back({"hay", Scene({{share(hay(900, 1)), glm::dmat4(1.0)}}), view});
  scenes.push_back({"crumbs", Scene({{share(hay(400, 2)), scaling({0.1, 0.1, 0.1})}, {share(hay(400, 3)), scaling({0.1, 0.1, 0.1})}}), view});
  // Exact orders are slow: few pixels, in more than one block.
  const View few = lookAt({3, 2, 4}, {0, 0, 0}, 12, 9, 0.05);
  for (const double gap : {1e-9, 1e-11, 1e-12}) scenes.push_back({fmt::format("squares {} apart", gap), closeSquares(gap, 13), few});
  scenes.push_back({"pencil", pencil(40), few});
  scenes.push_back({"pencil along the ray", pencil(20), lookAt({4, 0, 0}, {0, 0, 0}, 12, 9, 0.05)});
  return scenes;
}

void expectNearest(const NamedScene& named, const cpu::Frame& frame, const Stacks& all, std::uint32_t k, cpu::TileOptions options) {
  options.nearest = k;
  const Stacks kept = stacksOf(frame, options);
  std::size_t wrong = 0;
  std::uint64_t captured = 0;
  for (std::size_t i = 0; i < all.pixels.size(); ++i) {
    wrong += kept.pixels[i] != nearest(all.pixels[i], k);
    captured += std::min<std::uint64_t>(k, fragmentsOf(all.pixels[i]));
    ASSERT_EQ(kept.ends[i], all.pixels[i].empty() ? 0 : 1);
  }
  EXPECT_EQ(wrong, 0u) << named.name << ", K " << k;
  EXPECT_EQ(kept.counts.captured, captured) << named.name << ", K " << k;
  EXPECT_EQ(kept.counts.fragments, all.fragments()) << named.name << ", K " << k;
  EXPECT_EQ(kept.counts.coveredPixels, all.counts.coveredPixels) << named.name;
  EXPECT_EQ(kept.counts.depthComplexityMax, all.counts.depthComplexityMax) << named.name;
}

TEST(Nearest, areKeptWhateverTheScene) {
  for (const NamedScene& named : nearestScenes()) {
    const PlaneClasses planes(named.scene, named.name.starts_with("squares") ? 1e-16 : 0);
    const cpu::Frame frame(named.scene, planes, named.view);
    const Stacks all = stacksOf(frame);
    for (const std::uint32_t k : kLengths) expectNearest(named, frame, all, k, {});
  }
}

TEST(Nearest, areTheSameWhenEveryOrderIsDecidedExactly) {
  const NamedScene named{"hay", Scene({{share(hay(60, 5)), glm::dmat4(1.0)}}), lookAt({3, 2, 4}, {0, 0, 0}, 20, 10, 0.04)};
  const PlaneClasses planes(named.scene, 0);
  const cpu::Frame frame(named.scene, planes, named.view);
  cpu::TileOptions exactly;
  exactly.decideAllExactly = true;
  for (const std::uint32_t k : kLengths) expectNearest(named, frame, stacksOf(frame), k, exactly);
}

TEST(Nearest, doNotDependOnThreadsOrTheKernels) {
  const NamedScene named{"hay", Scene({{share(hay(900, 4)), glm::dmat4(1.0)}}), lookAt({3, 2, 4}, {0, 0, 0}, 70, 50, 0.012)};
  const PlaneClasses planes(named.scene, 0);
  const cpu::Frame frame(named.scene, planes, named.view);
  const Stacks all = stacksOf(frame);
  for (const int threads : {1, 2, 3}) Threads(threads).execute([&] { expectNearest(named, frame, all, 8, {}); });
  for (const char* target : {"scalar", "sse4", "avx2", "best"}) {
    cpu::chooseSimd(target);
    for (const std::uint32_t k : kLengths) expectNearest(named, frame, all, k, {});
  }
}

// A buffer of 41 holds all 41 squares; what one of 40 lacks is the farthest, by gaps that no key can tell.
TEST(Nearest, choosesExactlyWhereKeysCannot) {
  const Scene scene = closeSquares(1e-13, 41);
  const PlaneClasses planes(scene, 1e-16);
  ASSERT_EQ(planes.classes().size(), 42u);
  const View view = lookAt({0.1, 0.2, 5}, {0, 0, 0}, 5, 5, 0.01);
  const cpu::Frame frame(scene, planes, view);
  cpu::TileOptions options;
  options.nearest = 40;
  const Stacks kept = stacksOf(frame, options);
  EXPECT_GT(kept.counts.walk.decidedExactly, 0u);
  ASSERT_EQ(kept.at(2, 2).size(), 40u);
  for (unsigned i = 0; i < 40; ++i) EXPECT_EQ(kept.at(2, 2)[i].at(0).primitive / 2 * 7 % 41, 40 - i);
}

}  // namespace
}  // namespace copeel::test
