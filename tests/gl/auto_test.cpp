// The method that chooses: the stacks of `ll` whatever it chooses, within any budget that constant memory fits in.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/methods/method.h"
#include "tests/support/gl_scenes.h"
#include "tests/support/gl_stacks.h"

namespace copeel::test {
namespace {

constexpr std::uint32_t kCapacity = 640;

TEST(GlAuto, losesNothingAndKeepsToTheBudget) {
  std::set<std::string> chosen;
  for (const GlScene& scene : glScenes()) {
    const PlaneClasses planes(scene.scene, 0);
    gl::Renderer renderer(scene.scene, planes);
    const GlStacks all = glStacksOf(renderer, scene.view, findMethod("ll")->draw, {}, kCapacity);
    const std::uint64_t pixels = all.stacks.pixels.size();
    // The second is what sb takes and, of many fragments, lists do not.
    for (const std::uint64_t budget : {28 * pixels, std::max(28 * pixels, 8 * pixels + 8 * all.delivered + 300), 100 * pixels, 4000 * pixels, std::uint64_t{0}}) {
      SCOPED_TRACE(fmt::format("{}, {} bytes", scene.name, budget));
      for (int frame = 0; frame < 2; ++frame) {
        const GlStacks drawn = glStacksOf(renderer, scene.view, findMethod("auto")->draw, {.memoryBytes = budget}, kCapacity);
        EXPECT_TRUE(drawn.stacks.pixels == all.stacks.pixels);
        EXPECT_EQ(drawn.counts.method.overflow, 0u);
        if (budget > 0) {
          EXPECT_LE(drawn.counts.methodBytes, budget);
        }
        EXPECT_FALSE(drawn.counts.method.reason.empty());
        chosen.insert(drawn.counts.method.chosen);
      }
    }
  }
  EXPECT_TRUE(chosen.contains("fab"));
  EXPECT_TRUE(chosen.contains("sb"));
  EXPECT_TRUE(chosen.contains("hybrid"));
}

// A look that saw too little (here: none of a scene it is not of) costs a frame more passes and no fragment.
TEST(GlAuto, survivesAWrongLook) {
  const GlScene scene = glScenes()[0];
  const PlaneClasses planes(scene.scene, 0);
  gl::Renderer renderer(scene.scene, planes);
  const GlStacks all = glStacksOf(renderer, scene.view, findMethod("ll")->draw, {}, kCapacity);
  const std::uint64_t budget = 30 * all.stacks.pixels.size();
  renderer.frame().look = gl::Look{1, 1};
  const GlStacks drawn = glStacksOf(renderer, scene.view, findMethod("auto")->draw, {.memoryBytes = budget}, kCapacity);
  EXPECT_TRUE(drawn.stacks.pixels == all.stacks.pixels);
  EXPECT_LE(drawn.counts.methodBytes, budget);
  EXPECT_NE(drawn.counts.method.reason.find("too short"), std::string::npos) << drawn.counts.method.reason;
  EXPECT_TRUE(renderer.frame().look->wasTooLittle);
}

// Planes through the eye leave slivers where their triangles are clipped. Those are no fragments, and no method may count them as such before it knows.
TEST(GlAuto, sliversOfPlanesThroughTheEyeAreNoFragments) {
  const View view = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02);
  std::vector<Object> objects{{share(sphere(1, 17, 9)), glm::dmat4(1.0)}};
  for (int i = 0; i < 40; ++i) {
    const glm::dvec3 a = glm::normalize(view.forward + 0.013 * i * glm::normalize(view.right) - 0.2 * glm::normalize(view.down));
    const glm::dvec3 b = glm::normalize(glm::dvec3(std::cos(i), std::sin(i), std::sin(1.7 * i)));
    objects.push_back({share(quad(view.eye - 7.0 * a - 5.0 * b, view.eye + 9.0 * a - 5.0 * b, view.eye + 9.0 * a + 3.0 * b, view.eye - 7.0 * a + 3.0 * b)), glm::dmat4(1.0)});
  }
  const Scene scene(std::move(objects));
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  const GlStacks all = glStacksOf(renderer, view, findMethod("ll")->draw, {}, kCapacity);
  for (const MethodInfo& method : methods()) {
    if (!method.draw || !method.robust) continue;
    EXPECT_TRUE(glStacksOf(renderer, view, method.draw, {}, kCapacity).stacks.pixels == all.stacks.pixels) << method.name;
  }
  EXPECT_GT(renderer.frame().look->fragments, all.delivered) << "no slivers to tell apart";
}

// The look at a share of the pixels misses the deepest one. The first frame finds out, the second looks at all pixels, and then there is no more to find out.
TEST(GlAuto, looksAgainOnlyOnce) {
  const Scene scene = copiesOf(share(box({0, 0, 0}, {0.05, 0.05, 0.05})), 9);
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  const View view = above(320, 256);
  std::vector<std::uint64_t> passes;
  for (int frame = 0; frame < 4; ++frame) passes.push_back(glStacksOf(renderer, view, findMethod("auto")->draw, {}, 32).counts.passes);
  EXPECT_GT(passes[0], 2u) << "the first look saw all there is";
  EXPECT_EQ(passes[1], 2u);
  EXPECT_EQ(passes[2], 1u);
  EXPECT_EQ(passes[3], 1u);
}

TEST(GlAuto, isWhatTheBackEndsTake) {
  MethodOptions options;
  EXPECT_EQ(chooseMethod("gl", "auto", options).name, "auto");
  EXPECT_EQ(chooseMethod("cpu", "auto", options).name, "tile");
  EXPECT_EQ(chooseMethod("auto", "auto", options).name, "tile");
}

// A name that both back ends have is the cpu's, unless what it is to do is the other's.
TEST(GlChoice, ofANameOfBothBackEnds) {
  for (const char* name : {"kb", "k-plus"}) {
    MethodOptions options;
    EXPECT_EQ(&chooseMethod("auto", name, options), findMethod(name, "cpu"));
    EXPECT_EQ(&chooseMethod("cpu", name, options), findMethod(name, "cpu"));
    EXPECT_EQ(&chooseMethod("gl", name, options), findMethod(name, "gl"));
    EXPECT_NE(findMethod(name, "cpu"), findMethod(name, "gl"));
    EXPECT_FALSE(options.occupancy);
    EXPECT_EQ(&chooseMethod("auto", name + std::string("+occupancy"), options), findMethod(name, "gl"));
    EXPECT_TRUE(options.occupancy);
    EXPECT_THROW(chooseMethod("cpu", name + std::string("+occupancy"), options), Error);
  }
  MethodOptions options;
  EXPECT_EQ(chooseMethod("auto", "f2b+cull", options).backend, "gl");
  EXPECT_TRUE(options.cull);
  for (const char* none : {"", "f2c", "f2b+", "f2b+cul", "f2b+cull+occupancy", "auto+cull"}) EXPECT_THROW(chooseMethod("auto", none, options), Error) << none;
}

}  // namespace
}  // namespace copeel::test
