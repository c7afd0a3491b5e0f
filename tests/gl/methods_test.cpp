// Every method of the gl back end: robust ones deliver the same stacks, to the bit; those are the cpu back end's off edges.
#include <gtest/gtest.h>

#include "tests/support/gl_stacks.h"
#include "tests/support/meshes.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

Scene spheresAndBoxes() {
  const MeshPointer ball = share(sphere(1, 17, 9)), cube = share(box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}));
  return Scene({{ball, glm::dmat4(1.0)}, {ball, glm::dmat4(1.0)}, {cube, glm::dmat4(1.0)}, {cube, rotation({0, 0, 90})}});
}

View fromAside() { return lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02); }

std::size_t differing(const Stacks& a, const Stacks& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i];
  return count;
}

// Pixels that see the same triangles at all four corners of a sub-pixel step: none of their edges is near.
std::vector<bool> offEdges(const Scene& scene, const PlaneClasses& planes, const View& view) {
  std::vector<bool> off(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height), true);
  const Stacks center = stacksOf(cpu::Frame(scene, planes, view));
  for (const glm::dvec2 step : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
    View shifted = view;
    shifted.offset = step / 128.0;
    const Stacks there = stacksOf(cpu::Frame(scene, planes, shifted));
    for (std::size_t i = 0; i < off.size(); ++i) off[i] = off[i] && there.pixels[i] == center.pixels[i];
  }
  return off;
}

TEST(GlMethods, listsEqualTheTileMethodOffEdges) {
  const Scene scene = spheresAndBoxes();
  const PlaneClasses planes(scene, 0);
  for (const bool perspective : {true, false}) {
    View view = fromAside();
    view.perspective = perspective;
    if (!perspective) view.right *= 4.0, view.down *= 4.0;
    gl::Renderer renderer(scene, planes);
    const Stacks expected = stacksOf(cpu::Frame(scene, planes, view));
    const GlStacks lists = glStacksOf(renderer, view, findMethod("ll")->draw, {}, 64);
    const std::vector<bool> off = offEdges(scene, planes, view);
    std::size_t wrong = 0, compared = 0;
    for (std::size_t i = 0; i < off.size(); ++i) {
      if (!off[i] || expected.pixels[i].empty()) continue;
      ++compared;
      wrong += expected.pixels[i] != lists.stacks.pixels[i];
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(compared, 200u);
  }
}

TEST(GlMethods, robustOnesDeliverTheSameStacks) {
  const Scene scene = spheresAndBoxes();
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  const GlStacks lists = glStacksOf(renderer, fromAside(), findMethod("ll")->draw, {}, 64);
  for (const MethodInfo& method : methods()) {
    if (!method.draw) continue;
    const GlStacks stacks = glStacksOf(renderer, fromAside(), method.draw, {}, 64);
    EXPECT_LE(stacks.delivered, lists.delivered) << method.name;
    if (!method.robust) continue;
    EXPECT_EQ(differing(lists.stacks, stacks.stacks), 0u) << method.name;
  }
}

// Only pixels that the scene may cover are resolved: those that it covered in the view before are to be empty.
TEST(GlMethods, nothingStaysOfTheViewBefore) {
  const Scene scene = spheresAndBoxes();
  const PlaneClasses planes(scene, 0);
  const View views[] = {lookAt({3, 2, 4}, {1, 1, 0}, 64, 48, 0.02), lookAt({3, 2, 4}, {-1, -1, 0}, 64, 48, 0.02), lookAt({9, 6, 12}, {0, 0, 0}, 64, 48, 0.02),
                        lookAt({3, 2, 4}, {30, 0, 0}, 64, 48, 0.02), lookAt({0.1, 0.2, 0.3}, {1, 0, 0}, 40, 50, 0.02)};
  for (const char* name : {"ll", "f2b-zf", "sb"}) {
    const auto stacksIn = [&](gl::Renderer& renderer, const View& view, std::uint32_t capacity) {
      return glStacksOf(renderer, view, findMethod(name)->draw, {}, capacity).stacks;
    };
    std::vector<Stacks> expected;
    for (const View& view : views) {
      gl::Renderer fresh(scene, planes);
      expected.push_back(stacksIn(fresh, view, 64));
    }
    EXPECT_EQ(expected[3].fragments(), 0u);
    gl::Renderer renderer(scene, planes);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      EXPECT_EQ(differing(expected[i], stacksIn(renderer, views[i], 64)), 0u) << name << ", view " << i;
      // The same place and size, but not the same words a pixel.
      EXPECT_EQ(differing(expected[i], stacksIn(renderer, views[i], 50)), 0u) << name << ", view " << i;
    }
  }
}

// Regression: each has a context of its own, and only the last that was made was current.
TEST(GlMethods, renderersMayTakeTurns) {
  const Scene spheres = spheresAndBoxes();
  const PlaneClasses planes(spheres, 0);
  const auto stacksIn = [&](gl::Renderer& renderer) { return glStacksOf(renderer, fromAside(), findMethod("ll")->draw, {}, 64).stacks; };
  gl::Renderer first(spheres, planes);
  const Stacks expected = stacksIn(first);
  gl::Renderer second(spheres, planes);
  for (int turn = 0; turn < 2; ++turn) {
    gl::Renderer third(spheres, planes);
    EXPECT_EQ(differing(expected, stacksIn(second)), 0u);
    EXPECT_EQ(differing(expected, stacksIn(first)), 0u);
    EXPECT_EQ(differing(expected, stacksIn(third)), 0u);
  }
  EXPECT_EQ(differing(expected, stacksIn(first)), 0u);
}

}  // namespace
}  // namespace copeel::test
