// The method that chooses: the stacks of `ll` whatever it chooses, within any budget that constant memory fits in.
#include <gtest/gtest.h>

#include <algorithm>
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
  EXPECT_FALSE(renderer.frame().look);
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
