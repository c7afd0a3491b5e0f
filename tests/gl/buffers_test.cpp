// The methods that gather into buffers: robust ones deliver the stacks of `ll` to the bit, approximate ones exactly what they promise of them.
#include <functional>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "core/gl/context.h"
#include "core/methods/method.h"
#include "tests/support/gl_scenes.h"
#include "tests/support/gl_stacks.h"

namespace copeel::test {
namespace {

constexpr std::uint32_t kCapacity = 640;   // fragments recorded of a pixel: more than any scene of glScenes() has
const char* const kRobust[] = {"fab", "sb", "ll", "bun-ll"};

using Pixel = std::vector<Group>;

// A renderer with what `ll` delivers.
class Rendered {
 public:
  explicit Rendered(const GlScene& scene, std::uint32_t capacity = kCapacity)
      : view_(scene.view), capacity_(capacity), planes_(scene.scene, 0), renderer_(scene.scene, planes_), all_(stacksOf("ll")) {
    for (const Pixel& pixel : all_.stacks.pixels) deepest_ = std::max(deepest_, fragmentsOf(pixel));
  }
  GlStacks stacksOf(const char* method, const MethodOptions& options = {}) {
    return glStacksOf(renderer_, view_, findMethod(method, "gl")->draw, options, capacity_);
  }
  const std::vector<Pixel>& pixels() const { return all_.stacks.pixels; }
  std::uint64_t fragments() const { return all_.delivered; }
  const gl::FrameCounts& first() const { return all_.counts; }   // of `ll`, before its memory had grown
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
    const gl::FrameCounts ll = rendered.stacksOf("ll").counts;
    EXPECT_EQ(ll.methodBytes, pixels * 4 + 12 * std::max<std::size_t>(4 * pixels, rendered.fragments()) + 68) << scene.name;
    EXPECT_EQ(rendered.first().passes, rendered.fragments() > 4 * pixels ? 2u : 1u) << scene.name;
    EXPECT_EQ(ll.passes, 1u) << scene.name;
    // The fullest bucket is not known here; all of them are as large, and hold everything.
    const gl::FrameCounts bunLl = rendered.stacksOf("bun-ll").counts;
    const std::size_t places5 = (bunLl.methodBytes - pixels * 20 - 324) / 60, least = (4 * pixels + 4) / 5;
    EXPECT_EQ(bunLl.methodBytes, pixels * 20 + 60 * places5 + 324) << scene.name;
    EXPECT_EQ(bunLl.passes, 1 + bunLl.method.repeats) << scene.name;
    EXPECT_LE(bunLl.passes, 2u) << scene.name;
    EXPECT_GE(places5, std::max(least, (rendered.fragments() + 4) / 5)) << scene.name;
    EXPECT_LE(places5, std::max<std::size_t>(least, rendered.fragments())) << scene.name;
  }
}

// What the count fold says of each pixel: fragments, groups, largest group.
std::vector<std::uint32_t> countsOf(const Scene& scene, const View& view, const char* method) {
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  renderer.setView(view);
  gl::FoldSource fold;
  fold.defines = {{"FOLD", "core/fold/count.glsl"}};
  fold.stateWords = 4, fold.resultWords = 3;
  renderer.setFold(fold);
  renderer.draw(findMethod(method, "gl")->draw, {});
  return renderer.result();
}

TEST(GlBuffers, countsAgreeAndTheOrderOfObjectsAndTrianglesDoesNotMatter) {
  const Mesh ball = sphere(1, 17, 9), cube = box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7});
  const glm::dmat4 here(1.0);
  const Scene scene({{share(ball), here}, {share(ball), here}, {share(cube), here}, {share(cube), rotation({0, 0, 90})}});
  const Scene turned({{share(shuffled(cube)), rotation({0, 0, 90})}, {share(ball), here}, {share(cube), here}, {share(shuffled(ball)), here}});
  const View view = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02);
  const std::vector<std::uint32_t> expected = countsOf(scene, view, "ll");
  ASSERT_GE(*std::max_element(expected.begin(), expected.end()), 6u);
  for (const char* method : kRobust) {
    EXPECT_EQ(countsOf(scene, view, method), expected) << method;
    EXPECT_EQ(countsOf(turned, view, method), expected) << method;
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
    const GlStacks stacks = glStacksOf(renderer, above(3, 2, 0.1), findMethod(method, "gl")->draw, {}, 10'000);
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

// Pixels of 1 to 140 fragments side by side: some fit registers, some a small array, some a large one, some none, in one picture. In the low view most pixels that
// have any have many, and lists are not tried with the small array first.
TEST(GlBuffers, stacksOfAllHeightsSideBySide) {
  const Scene scene({{share(stairs()), glm::dmat4(1.0)}});
  const PlaneClasses planes(scene, 0);
  for (const int rows : {24, 2}) {
    for (const char* method : kRobust) {
      SCOPED_TRACE(fmt::format("{}, {} rows", method, rows));
      gl::Renderer renderer(scene, planes);   // one that has drawn would have the results of pixels that this method leaves out
      const GlStacks stacks = glStacksOf(renderer, above(kStairs, rows, 1), findMethod(method, "gl")->draw, {}, kStairs);
      ASSERT_EQ(stacks.delivered, 2u * kStairs * (kStairs + 1) / 2);
      for (int x = 0; x < kStairs; ++x) {
        std::map<double, std::vector<std::uint32_t>, std::greater<>> expected;   // nearest first
        for (int i = 0; i <= x; ++i) expected[heightOfSheet(i)].push_back(static_cast<std::uint32_t>(i));
        const Pixel& pixel = stacks.stacks.pixels[static_cast<std::size_t>(rows / 2 * kStairs + x)];
        ASSERT_EQ(pixel.size(), expected.size()) << x;
        auto group = pixel.begin();
        for (const auto& [height, sheets] : expected) {
          std::vector<std::uint32_t> found;
          for (const Crossing& crossing : *group++) found.push_back(crossing.primitive / 2);
          ASSERT_EQ(found, sheets) << "pixel " << x << ", height " << height;
        }
      }
    }
  }
}

// Twenty balls within a tile or two: one of eight memories has to hold most, and --memory that is enough for all nodes in one memory is not for these.
TEST(GlBuffers, nodesOfALargePictureLieInEightMemoriesWhereTheyFit) {
  const GlScene scene{"balls", copiesOf(share(sphere(1, 17, 9)), 20), lookAt({3, 2, 4}, {0, 0, 0}, 512, 300, 0.012)};
  Rendered rendered(scene, 40);
  const std::size_t pixels = rendered.pixelCount(), fragments = rendered.fragments();
  ASSERT_GT(fragments, 20'000u);
  const GlStacks arrays = rendered.stacksOf("fab");
  EXPECT_TRUE(arrays.stacks.pixels == rendered.pixels());
  const gl::FrameCounts inEight = rendered.stacksOf("ll").counts;
  EXPECT_EQ(inEight.methodBytes, pixels * 4 + 96 * ((4 * pixels + 7) / 8) + 516);
  EXPECT_EQ(inEight.passes, 1u);
  const GlStacks inOne = Rendered(scene, 40).stacksOf("ll", {.memoryBytes = pixels * 4 + fragments * 12 + 1000});
  EXPECT_TRUE(inOne.stacks.pixels == rendered.pixels());
  EXPECT_EQ(inOne.counts.method.overflow, 0u);
  EXPECT_LE(inOne.counts.methodBytes, pixels * 4 + fragments * 12 + 1000);
}

// One invocation walks the five lists of a pixel: together they are held to what drivers' loops allow.
TEST(GlBuffers, listsOfBucketsAreCountedTogether) {
  const auto stackOf = [](std::uint32_t count) {
    Mesh stack;
    for (std::uint32_t i = 0; i < count; ++i) {
      const double z = 0.001 * i;
      for (const glm::dvec3 corner : {glm::dvec3(-9, -9, z), glm::dvec3(9, -9, z), glm::dvec3(0, 9, z)}) stack.vertices.push_back(corner);
      stack.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    return Scene({{share(stack), glm::dmat4(1.0)}});
  };
  const Scene some = stackOf(18'000), tooMany = stackOf(30'000);
  const PlaneClasses planesOfSome(some, 0), planesOfTooMany(tooMany, 0);
  gl::Renderer renderer(some, planesOfSome), refusing(tooMany, planesOfTooMany);
  const GlStacks stacks = glStacksOf(renderer, above(1, 1, 0.1), findMethod("bun-ll")->draw, {}, 18'000);
  ASSERT_EQ(stacks.stacks.pixels[0].size(), 18'000u);
  for (std::uint32_t i = 0; i < 18'000; ++i) ASSERT_EQ(stacks.stacks.pixels[0][i][0].primitive, 17'999 - i);
  EXPECT_THROW(glStacksOf(refusing, above(1, 1, 0.1), findMethod("bun-ll")->draw, {}, 30'000), Error);
}

// A driver would end in a fault rather than say so.
TEST(GlBuffers, whatShadersCannotAddressIsRefused) {
  const Scene scene = copiesOf(share(squareAt(0)), 1);
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  EXPECT_THROW(gl::Buffer((std::size_t{1} << 31) + 4), Error);
  for (const char* method : {"kb", "k-plus", "srab"}) {
    EXPECT_THROW(glStacksOf(renderer, above(640, 420), findMethod(method, "gl")->draw, {.k = 1024}, 1), Error) << method;
  }
}

TEST(GlBuffers, sharesOfMemoryAddUpToTheLimit) {
  const gl::Context context;
  gl::DeviceMemory::limit(1 << 20);
  {
    gl::Buffer first(600'000);
    EXPECT_THROW(gl::Buffer(600'000), Error);
    first = gl::Buffer();
    EXPECT_EQ(gl::DeviceMemory::left(), 1u << 20);
    const gl::Buffer second(600'000), third(400'000);
    EXPECT_EQ(gl::DeviceMemory::left(), (1u << 20) - 1'000'000);
  }
  EXPECT_EQ(gl::DeviceMemory::left(), 1u << 20);
  gl::DeviceMemory::limit(0);
  EXPECT_EQ(gl::DeviceMemory::left(), ~std::uint64_t{0});
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

// Whether the fragments of `part` are some of `whole`, in its groups and order.
bool isPartOf(const Pixel& part, const Pixel& whole) {
  auto group = whole.begin();
  for (const Group& some : part) {
    const auto holds = [&](const Group& all) {
      return std::all_of(some.begin(), some.end(), [&](const Crossing& c) { return std::find(all.begin(), all.end(), c) != all.end(); });
    };
    group = std::find_if(group, whole.end(), holds);
    if (group == whole.end()) return false;
    ++group;
  }
  return true;
}

TEST(GlBuffers, routedOnesKeepKFragments) {
  for (const GlScene& scene : glScenes()) {
    Rendered rendered(scene);
    for (const std::uint32_t k : {1u, 2u, 8u, 32u}) {
      const GlStacks stacks = rendered.stacksOf("srab", {.k = k});
      for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
        const Pixel &part = stacks.stacks.pixels[i], &whole = rendered.pixels()[i];
        ASSERT_EQ(fragmentsOf(part), std::min<std::size_t>(k, fragmentsOf(whole))) << scene.name << ", K " << k;
        ASSERT_TRUE(isPartOf(part, whole)) << scene.name << ", K " << k;
      }
      EXPECT_EQ(stacks.delivered + stacks.counts.method.overflow, rendered.fragments()) << scene.name;
      EXPECT_EQ(stacks.counts.passes, 1u);
      EXPECT_EQ(stacks.counts.methodBytes, rendered.pixelCount() * (8 * k + 4) + 4 + 4);
    }
  }
}

// The more fragments behind the k-th are turned away, the more places are left for near ones.
TEST(GlBuffers, occupancyBringsRoutedOnesNearer) {
  const GlScene scene = glScenes()[10];
  Rendered rendered(scene);
  const auto nearestDelivered = [&](bool occupancy) {
    const GlStacks stacks = rendered.stacksOf("srab", {.k = 8, .occupancy = occupancy, .occupancyWords = 64});
    std::size_t count = 0;
    for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
      for (const Group& group : nearest(rendered.pixels()[i], 8)) {
        const auto& groups = stacks.stacks.pixels[i];
        count += std::find(groups.begin(), groups.end(), group) != groups.end();
      }
    }
    return count;
  };
  EXPECT_LT(nearestDelivered(false), nearestDelivered(true));
}

TEST(GlBuffers, occupancyShortensLists) {
  for (const GlScene& scene : glScenes()) {
    Rendered rendered(scene);
    const GlStacks stacks = rendered.stacksOf("ll", {.k = 4, .occupancy = true});
    for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
      const Pixel &part = stacks.stacks.pixels[i], &whole = rendered.pixels()[i];
      // What is left is the whole front of the stack, of 4 fragments at least.
      ASSERT_GE(fragmentsOf(part), std::min<std::size_t>(4, fragmentsOf(whole))) << scene.name;
      ASSERT_TRUE(part == Pixel(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(part.size()))) << scene.name;
    }
    if (scene.name == "300 layers") {
      EXPECT_LT(stacks.delivered * 10, rendered.fragments());
    }
  }
}

TEST(GlBuffers, multipassKBufferPeelsEveryLayer) {
  const bool software = gl::Context().isSoftware();   // at an end before there is another
  for (const GlScene& scene : glScenes()) {
    Rendered rendered(scene);
    for (const std::uint32_t k : {1u, 2u, 8u, 32u}) {
      if (k <= 2 && rendered.deepest() > 200) continue;   // hundreds of passes
      const GlStacks stacks = rendered.stacksOf("multi-kb", {.k = k});
      std::size_t layers = 0;
      for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
        const Pixel &part = stacks.stacks.pixels[i], &whole = rendered.pixels()[i];
        layers = std::max(layers, whole.size());
        ASSERT_EQ(part.size(), whole.size()) << scene.name << ", K " << k;
        ASSERT_EQ(fragmentsOf(part), whole.size()) << scene.name << ", K " << k;
        ASSERT_TRUE(isPartOf(part, whole)) << scene.name << ", K " << k;
      }
      // Coplanar fragments that meet in a buffer take places that layers had, and then there is a batch more.
      const std::uint64_t passes = 2 * ((layers + k - 1) / k) + 1 + stacks.counts.method.repeats;
      EXPECT_GE(stacks.counts.passes, passes) << scene.name << ", K " << k;
      EXPECT_TRUE(stacks.counts.passes == passes || !software) << scene.name << ", K " << k;
      EXPECT_EQ(stacks.counts.methodBytes, rendered.pixelCount() * (8 * k + 4));
    }
  }
}

TEST(GlBuffers, bucketsKeepTheirEnds) {
  for (const GlScene& scene : glScenes()) {
    Rendered rendered(scene);
    for (const char* method : {"bun", "bad"}) {
      const GlStacks stacks = rendered.stacksOf(method, {.k = 8});
      for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
        const Pixel &part = stacks.stacks.pixels[i], &whole = rendered.pixels()[i];
        ASSERT_TRUE(isPartOf(part, whole)) << scene.name << ", " << method;
        ASSERT_EQ(fragmentsOf(part), part.size()) << scene.name << ", " << method;
        // The nearest and the farthest layer are ends of their buckets, whatever these are; of each the later primitive is kept.
        ASSERT_GE(part.size(), std::min<std::size_t>(2, whole.size())) << scene.name << ", " << method;
        if (whole.empty()) continue;
        ASSERT_EQ(part.front().back(), whole.front().back()) << scene.name << ", " << method;
        ASSERT_EQ(part.back().back(), whole.back().back()) << scene.name << ", " << method;
        // Equal steps of depth fill all buckets.
        if (scene.name == "300 layers") {
          ASSERT_EQ(part.size(), 16u) << method;
        }
      }
      const bool adaptive = method == std::string("bad");
      EXPECT_EQ(stacks.counts.passes, adaptive ? 4u : 2u);
      EXPECT_EQ(stacks.counts.methodBytes, rendered.pixelCount() * (16 * 8 + (adaptive ? 40 : 0))) << method;
    }
  }
}

// Eight layers close together and one far behind: uniform buckets lose six of them, adaptive ones none.
TEST(GlBuffers, adaptiveBucketsFollowTheFragments) {
  const MeshPointer square = share(squareAt(0));
  std::vector<Object> objects = {{square, translation({0, 0, -1})}};
  for (int i = 0; i < 8; ++i) objects.push_back({square, translation({0, 0, 0.02 * i})});
  const GlScene scene{"bundle", Scene(std::move(objects)), above(16, 12, 0.1)};
  Rendered rendered(scene);
  for (std::size_t i = 0; i < rendered.pixels().size(); ++i) {
    if (rendered.pixels()[i].empty()) continue;
    EXPECT_EQ(rendered.stacksOf("bun", {.k = 4}).stacks.pixels[i].size(), 3u);
    EXPECT_EQ(rendered.stacksOf("bad", {.k = 9}).stacks.pixels[i].size(), 9u);
    break;
  }
}

}  // namespace
}  // namespace copeel::test
