// The method that chooses: the stacks of `ll` whatever it chooses, within any budget that constant memory fits in.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

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
    for (const std::uint64_t budget : {28 * pixels, 40 * pixels + 300, 100 * pixels, 4000 * pixels, std::uint64_t{0}}) {
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

TEST(GlAuto, isWhatTheBackEndsTake) {
  EXPECT_EQ(chooseMethod("gl", "auto").name, "auto");
  EXPECT_EQ(chooseMethod("cpu", "auto").name, "tile");
  EXPECT_EQ(chooseMethod("auto", "auto").name, "tile");
}

}  // namespace
}  // namespace copeel::test
