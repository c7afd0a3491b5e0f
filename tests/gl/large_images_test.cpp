// The widest images by every method of the gl back end: each fragment is counted, as robust methods and formulas promise. Slow.
#include <gtest/gtest.h>

#include "core/gl/measure.h"
#include "tests/support/hard_gl_scenes.h"
#include "tests/support/stacks.h"

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

}  // namespace
}  // namespace copeel::test
