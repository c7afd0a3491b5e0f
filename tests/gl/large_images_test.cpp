// The widest images by every method of the gl back end: each fragment is counted, as robust methods and formulas promise. Slow.
#include <gtest/gtest.h>

#include "apps/oit/render_oit.h"
#include "core/error.h"
#include "core/gl/measure.h"
#include "tests/support/hard_gl_scenes.h"
#include "tests/support/meshes.h"
#include "tests/support/stacks.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

TEST(GlLargeImages, countEveryFragment) {
  const NamedScene named = extremeImage(16384, 16);
  const PlaneClasses planes(named.scene, 0);
  const auto onCpu = static_cast<double>(stacksOf(cpu::Frame(named.scene, planes, named.view)).fragments());
  ASSERT_GT(onCpu, 10'000);
  gl::Renderer renderer(named.scene, planes);
  renderer.setView(named.view);
  for (const MethodInfo& method : methods()) {
    if (!method.draw) continue;
    Stats stats;
    gl::measure(renderer, method, {}, stats);
    EXPECT_NEAR(static_cast<double>(stats.fragments), onCpu, 0.02 * onCpu) << method.name;   // the rasterizers differ on edges
    // Three balls have no more than eight fragments in a pixel: buffers of eight hold them all.
    const bool holdsEight = method.name == "kb" || method.name == "k-plus" || method.name == "srab" || method.name == "f2b-fab";
    if (method.robust || holdsEight) {
      EXPECT_EQ(stats.rh(), 1.0) << method.name;
    } else {
      EXPECT_LE(stats.fragmentsCaptured, stats.fragments) << method.name;
    }
  }
}

// 4096 x 4096: states would take 3.2 GB, results take 0.8. Methods that deliver a pixel in one invocation have no states, the others say so.
TEST(GlLargeImages, whoseStatesAreTooManyAreForOnePass) {
  const MeshPointer ball = share(sphere(1, 17, 9));
  const std::vector<oit::Part> parts{{ball, {255, 0, 0, 0.5f}, {}, glm::dmat4(1.0)}, {ball, {0, 0, 255, 0.5f}, {}, glm::dmat4(1.0)}};
  const View view = lookAt({3, 2, 4}, {0, 0, 0}, 4096, 4096, 0.02 / 64);
  oit::RenderOptions options;
  options.method = findMethod("sb");
  oit::Renderer renderer(parts, options);
  const UninitializedVector<Rgb8> expected = renderer.draw(view).color.pixels, onCpu = oit::Renderer(parts, {}).draw(view).color.pixels;
  std::size_t different = 0, covered = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    covered += onCpu[i] != onCpu[0];
    different += onCpu[i] != expected[i];
  }
  EXPECT_GT(covered, 1'000'000u);
  EXPECT_LT(different, 3000u);   // edges
  for (const char* name : {"ll", "bun-ll", "fab", "auto"}) {
    renderer.setMethod(*findMethod(name, "gl"), {});
    EXPECT_TRUE(renderer.draw(view).color.pixels == expected) << name;
  }
  renderer.setMethod(*findMethod("f2b-ll"), {});
  try {
    renderer.draw(view);
    ADD_FAILURE() << "drawn";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("MB for the state"), std::string::npos) << error.what();
  }
  // What the larger image took is not asked for again.
  EXPECT_NO_THROW(renderer.draw(lookAt({3, 2, 4}, {0, 0, 0}, 3000, 3000, 0.02 / 47)));
}

}  // namespace
}  // namespace copeel::test
