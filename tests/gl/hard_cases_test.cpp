// The hard cases by every method of the gl back end: robust ones deliver every fragment, and the stacks of `ll`; approximate ones miss exactly what
// their formulas say. And what the measurement says of orders that keys leave open.
#include <gtest/gtest.h>

#include "core/gl/measure.h"
#include "tests/support/gl_stacks.h"
#include "tests/support/hard_gl_scenes.h"

namespace copeel::test {
namespace {

constexpr std::uint32_t kCapacity = 320;   // fragments of a pixel of any scene here, and more
constexpr std::uint32_t kLength = 8;       // K

using Pixel = std::vector<Group>;

bool isOneOf(std::string_view name, std::initializer_list<std::string_view> names) { return std::find(names.begin(), names.end(), name) != names.end(); }

// What a method has to deliver of a pixel: at least and at most. Where fragments met in a k-buffer, and it says so, one of them is all it promises.
std::pair<std::size_t, std::size_t> promised(const MethodInfo& method, const Pixel& pixel, bool hazards) {
  const std::size_t fragments = fragmentsOf(pixel), depths = pixel.size();
  if (method.robust) return {fragments, fragments};
  if (isOneOf(method.name, {"f2b", "f2b2", "dual", "multi-kb"})) return {depths, depths};
  if (isOneOf(method.name, {"bun", "bad"})) return {std::min<std::size_t>(2, depths), depths};
  const std::size_t kept = std::min<std::size_t>(kLength, fragments);
  if (isOneOf(method.name, {"kb", "k-plus", "srab"})) return {hazards ? std::min<std::size_t>(1, kept) : kept, kept};
  std::size_t perDepth = 0;
  for (const Group& group : pixel) perDepth += std::min<std::size_t>(kLength, group.size());
  return {perDepth, perDepth};
}

void expectPromised(const NamedScene& named, std::uint32_t capacity) {
  const PlaneClasses planes(named.scene, 0);
  gl::Renderer renderer(named.scene, planes);
  const GlStacks all = glStacksOf(renderer, named.view, findMethod("ll")->draw, {}, capacity);
  ASSERT_GT(all.delivered, 0u);
  for (const MethodInfo& method : methods()) {
    if (!method.draw) continue;
    const GlStacks drawn = glStacksOf(renderer, named.view, method.draw, {.k = kLength}, capacity);
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < all.stacks.pixels.size(); ++i) {
      const auto [least, most] = promised(method, all.stacks.pixels[i], drawn.counts.method.hazards > 0);
      const std::size_t delivered = fragmentsOf(drawn.stacks.pixels[i]);
      wrong += delivered < least || delivered > most || (method.robust && drawn.stacks.pixels[i] != all.stacks.pixels[i]);
    }
    EXPECT_EQ(wrong, 0u) << method.name;
    if (method.robust) {
      EXPECT_EQ(drawn.delivered, all.delivered) << method.name;
      EXPECT_EQ(drawn.counts.method.overflow, 0u) << method.name;
    }
  }
}

class GlHardCases : public testing::TestWithParam<std::size_t> {};

TEST_P(GlHardCases, everyMethodDeliversWhatItPromises) { expectPromised(hardGlScenes()[GetParam()], kCapacity); }

INSTANTIATE_TEST_SUITE_P(Scenes, GlHardCases, testing::Range<std::size_t>(0, hardGlScenes().size()), [](const auto& scene) {
  std::string name = hardGlScenes()[scene.param].name;
  std::replace_if(name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return name;
});

TEST(GlHardImages, ofExtremeShape) {
  for (const auto& [width, height] : {std::pair{1, 1}, {2048, 1}, {1, 16384}}) expectPromised(extremeImage(width, height), 16);
}

std::uint64_t uncertainOf(const Scene& scene, double tolerance) {
  const PlaneClasses planes(scene, tolerance);
  gl::Renderer renderer(scene, planes);
  renderer.setView(lookAt({0.51, 0.52, 20}, {0.5, 0.5, 0}, 16, 12, 0.004));
  Stats stats;
  gl::measure(renderer, *findMethod("f2b"), {}, stats);
  EXPECT_EQ(stats.coveredPixels, 16u * 12);
  return stats.uncertain;
}

// Keys of 30 bits over a depth of 10: two planes 1e-10 apart share keys or have neighbouring ones in every pixel, two that are 0.1 apart in none.
TEST(GlUncertain, ordersAreCounted) {
  const MeshPointer square = share(quad({-5, -5, 0}, {6, -5, 0}, {6, 6, 0}, {-5, 6, 0}));
  const auto two = [&](double gap) {
    return Scene({{square, translation({0, 0, gap})}, {square, glm::dmat4(1.0)}, {square, translation({0, 0, -10})}});
  };
  EXPECT_EQ(uncertainOf(two(0.1), 1e-12), 0u);
  EXPECT_EQ(uncertainOf(two(1e-10), 1e-12), 16u * 12);
  // Of one class they are coplanar, and there is nothing to be uncertain of.
  EXPECT_EQ(uncertainOf(two(1e-10), 1e-6), 0u);
  EXPECT_EQ(uncertainOf(two(0), 1e-12), 0u);
}

}  // namespace
}  // namespace copeel::test
