// Every method of the gl back end against the cpu back end's stacks: the same fragments, in the same groups, in the same order.
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/gl_stacks.h"
#include "tests/support/meshes.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

Scene spheresAndBox() {
  const MeshPointer ball = share(sphere(1, 17, 9)), cube = share(box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}));
  return Scene({{ball, glm::dmat4(1.0)}, {ball, glm::dmat4(1.0)}, {cube, glm::dmat4(1.0)}, {cube, rotation({0, 0, 90})}});
}

std::size_t differing(const Stacks& a, const Stacks& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) count += a.pixels[i] != b.pixels[i];
  return count;
}

TEST(GlMethods, listsEqualTheTileMethod) {
  const Scene scene = spheresAndBox();
  const PlaneClasses planes(scene, 0);
  const View view = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02);
  gl::Renderer renderer(scene, planes);
  std::printf("%s\n", renderer.context().renderer().c_str());
  const Stacks expected = stacksOf(cpu::Frame(scene, planes, view));
  const GlStacks ll = glStacksOf(renderer, view, findMethod("ll")->draw, {}, 64);
  EXPECT_EQ(differing(expected, ll.stacks), 0u);
  EXPECT_EQ(ll.delivered, expected.fragments());
  const GlStacks f2b = glStacksOf(renderer, view, findMethod("f2b")->draw, {}, 64);
  std::printf("%zu %zu passes %zu bytes %zu %zu\n", ll.delivered, f2b.delivered, f2b.counts.passes, f2b.counts.methodBytes, ll.counts.methodBytes);
}

}  // namespace
}  // namespace copeel::test
