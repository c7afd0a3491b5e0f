// The methods that gather into buffers: robust ones deliver the stacks of `ll` to the bit, approximate ones exactly what they promise of them.
#include <gtest/gtest.h>

#include "core/methods/method.h"
#include "tests/support/gl_scenes.h"
#include "tests/support/gl_stacks.h"

namespace copeel::test {
namespace {

constexpr std::uint32_t kCapacity = 640;   // fragments recorded of a pixel: more than any scene of glScenes() has
const char* const kRobust[] = {"fab", "sb", "ll", "bun-ll"};

using Pixel = std::vector<Group>;

std::size_t fragmentsOf(const Pixel& pixel) {
  std::size_t count = 0;
  for (const Group& group : pixel) count += group.size();
  return count;
}

// The K nearest fragments: within a group, which stacks hold by primitive, later ones lie in front.
Pixel nearest(const Pixel& pixel, std::size_t k) {
  Pixel result;
  for (const Group& group : pixel) {
    const std::size_t count = std::min(k, group.size());
    if (count == 0) break;
    result.emplace_back(group.end() - static_cast<std::ptrdiff_t>(count), group.end());
    k -= count;
  }
  return result;
}

// A renderer with what `ll` delivers.
class Rendered {
 public:
  explicit Rendered(const GlScene& scene, std::uint32_t capacity = kCapacity)
      : view_(scene.view), capacity_(capacity), planes_(scene.scene, 0), renderer_(scene.scene, planes_), all_(stacksOf("ll")) {
    for (const Pixel& pixel : all_.stacks.pixels) deepest_ = std::max(deepest_, fragmentsOf(pixel));
  }
  GlStacks stacksOf(const char* method, const MethodOptions& options = {}) {
    return glStacksOf(renderer_, view_, findMethod(method)->draw, options, capacity_);
  }
  const std::vector<Pixel>& pixels() const { return all_.stacks.pixels; }
  std::uint64_t fragments() const { return all_.delivered; }
  std::size_t deepest() const { return deepest_; }        // fragments in a pixel
  std::size_t pixelCount() const { return all_.stacks.pixels.size(); }

 private:
  View view_;
  std::uint32_t capacity_;
  PlaneClasses planes_;
  gl::Renderer renderer_;
  GlStacks all_;
  std::size_t deepest_ = 0;
};

TEST(GlBuffers, robustOnesDeliverTheStacksOfLists) {
  for (const GlScene& scene : glScenes()) {
    Rendered rendered(scene);
    for (const char* method : kRobust) {
      for (int frame = 0; frame < 2; ++frame) {
        const GlStacks stacks = rendered.stacksOf(method);
        EXPECT_TRUE(stacks.stacks.pixels == rendered.pixels()) << scene.name << ", " << method << ", frame " << frame;
        EXPECT_EQ(stacks.delivered, rendered.fragments()) << scene.name << ", " << method;
        EXPECT_EQ(stacks.counts.method.overflow, 0u) << scene.name << ", " << method;
      }
    }
  }
}

TEST(GlBuffers, passesAndBytesEqualTheirFormulas) {
  for (const GlScene& scene : glScenes()) {
    Rendered rendered(scene);
    const std::size_t pixels = rendered.pixelCount(), places = std::max<std::size_t>(8, rendered.deepest());
    const gl::FrameCounts fab = rendered.stacksOf("fab", {.k = 8}).counts;
    EXPECT_EQ(fab.methodBytes, pixels * (4 + 8 * places) + 8 + 4) << scene.name;
    EXPECT_EQ(fab.passes, rendered.deepest() > 8 ? 2u : 1u) << scene.name;
    const gl::FrameCounts sb = rendered.stacksOf("sb").counts;
    EXPECT_EQ(sb.methodBytes, pixels * 8 + rendered.fragments() * 8 + 260 + 4) << scene.name;
    EXPECT_EQ(sb.passes, 2u) << scene.name;
  }
}

TEST(GlBuffers, whatMemoryDoesNotHoldIsCounted) {
  const GlScene scene{"balls", copiesOf(share(sphere(1, 17, 9)), 5), lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02)};
  Rendered rendered(scene);
  const std::uint64_t all = rendered.fragments();
  ASSERT_GT(all, 2500u);
  for (const char* method : kRobust) {
    for (const std::uint64_t bytes : {4'000u, 16'000u, 24'000u}) {
      const GlStacks stacks = rendered.stacksOf(method, {.k = 1, .memoryBytes = bytes});
      EXPECT_GT(stacks.counts.method.overflow, 0u) << method << ", " << bytes;
      EXPECT_EQ(stacks.delivered + stacks.counts.method.overflow, all) << method << ", " << bytes;
      EXPECT_LE(stacks.counts.methodBytes, std::max<std::uint64_t>(bytes, 64 * 48 * 20 + 400)) << method << ", " << bytes;
    }
    EXPECT_EQ(rendered.stacksOf(method).delivered, all) << method;
  }
}

TEST(GlBuffers, tenThousandFragmentsInAPixel) {
  // Every second square lies on the one before: 5,000 groups of two, in a pixel that no driver's loop limit may cut off.
  const MeshPointer square = share(squareAt(0));
  std::vector<Object> objects;
  for (int i = 0; i < 10'000; ++i) objects.push_back({square, translation({0, 0, 0.001 * (i * 7 % 5000)})});
  const Scene scene(std::move(objects));
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  for (const char* method : kRobust) {
    const GlStacks stacks = glStacksOf(renderer, above(3, 2, 0.1), findMethod(method)->draw, {}, 10'000);
    for (const Pixel& pixel : stacks.stacks.pixels) {
      ASSERT_EQ(pixel.size(), 5000u) << method;
      for (std::size_t i = 0; i < pixel.size(); ++i) {
        ASSERT_EQ(pixel[i].size(), 2u) << method << ", group " << i;
        // The highest is nearest: square number 4999 - i counted upwards.
        ASSERT_EQ(pixel[i][0].primitive / 2 * 7 % 5000, 4999 - i) << method;
        ASSERT_EQ(pixel[i][1].primitive / 2, pixel[i][0].primitive / 2 + 5000) << method;
      }
    }
  }
}

TEST(GlBuffers, kBuffersKeepTheNearest) {
  for (const GlScene& scene : glScenes()) {
    Rendered rendered(scene);
    for (const std::uint32_t k : {1u, 2u, 8u, 32u}) {
      for (const char* method : {"kb", "k-plus"}) {
        for (const bool occupancy : {false, true}) {
          const GlStacks stacks = rendered.stacksOf(method, {.k = k, .occupancy = occupancy});
          const gl::FrameCounts& counts = stacks.counts;
          if (counts.method.hazards > 0) continue;   // the device met them and says so: then no promise holds
          std::size_t wrong = 0;
          for (std::size_t i = 0; i < stacks.stacks.pixels.size(); ++i) wrong += stacks.stacks.pixels[i] != nearest(rendered.pixels()[i], k);
          EXPECT_EQ(wrong, 0u) << scene.name << ", " << method << ", K " << k << ", occupancy " << occupancy;
          EXPECT_EQ(counts.passes, occupancy ? 2u : 1u);
          EXPECT_EQ(counts.methodBytes, rendered.pixelCount() * (8 * k + 8 + (occupancy ? 4 * 5 : 0)) + 8 + 4) << scene.name << ", " << method;
          if (occupancy) continue;
          EXPECT_EQ(stacks.delivered + counts.method.overflow, rendered.fragments()) << scene.name << ", " << method;
        }
      }
    }
  }
}

// Lemma 2.1 of 2015, at every resolution of the maps; and fragments are in fact turned away.
TEST(GlBuffers, occupancyKeepsTheNearestAtEveryResolution) {
  for (const GlScene& scene : glScenes()) {
    if (scene.name != "300 layers" && scene.name != "voxel city") continue;
    Rendered rendered(scene);
    for (const std::uint32_t words : {1u, 2u, 7u, 64u}) {
      const GlStacks stacks = rendered.stacksOf("k-plus", {.k = 4, .occupancy = true, .occupancyWords = words});
      for (std::size_t i = 0; i < rendered.pixels().size(); ++i) ASSERT_EQ(stacks.stacks.pixels[i], nearest(rendered.pixels()[i], 4)) << words;
      EXPECT_LT(stacks.delivered + stacks.counts.method.overflow, rendered.fragments()) << scene.name << ", d " << words;
    }
  }
}

}  // namespace
}  // namespace copeel::test
