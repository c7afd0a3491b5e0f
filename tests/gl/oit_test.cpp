// Transparency through the gl back end: robust methods give the same picture to the byte, and the cpu's off edges.
#include <gtest/gtest.h>

#include "apps/oit/render_oit.h"
#include "core/methods/method.h"
#include "tests/support/meshes.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

// Coincident and crossing bodies, most of them translucent; the last is opaque and hides.
std::vector<oit::Part> bodies() {
  const MeshPointer ball = share(sphere(1, 17, 9)), cube = share(box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}));
  const MeshPointer post = share(box({-0.2, -0.2, -1.5}, {0.2, 0.2, 1.5}));
  return {{ball, {200, 30, 30, 0.5}, {}, glm::dmat4(1.0)}, {ball, {30, 200, 30, 0.3}, {}, glm::dmat4(1.0)}, {cube, {30, 30, 200, 0.5}, {}, glm::dmat4(1.0)},
          {cube, {200, 200, 30, 0.25}, {}, rotation({0, 0, 90})}, {cube, {90, 90, 90, 0}, {}, glm::dmat4(1.0)}, {post, {250, 250, 250, 1}, {}, glm::dmat4(1.0)}};
}

oit::Frame drawnWith(std::string_view method, double offset = 0) {
  oit::RenderOptions options;
  options.method = method;
  options.lights = {{{1, 2, 3}, 0.7}, {{-2, 1, 0.5}, 0.4}};
  options.wantDepth = options.wantIds = options.wantLayers = options.wantCoplanar = true;
  View view = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02);
  view.offset = {offset, offset};
  return oit::Renderer(bodies(), options).draw(view);
}

TEST(GlOit, robustMethodsGiveTheSameBytes) {
  const oit::Frame lists = drawnWith("ll");
  for (const MethodInfo& method : methods()) {
    if (!method.draw || !method.robust) continue;
    const oit::Frame frame = drawnWith(method.name);
    EXPECT_EQ(frame.color.pixels, lists.color.pixels) << method.name;
    EXPECT_EQ(frame.depth.pixels, lists.depth.pixels) << method.name;
    EXPECT_EQ(frame.ids.pixels, lists.ids.pixels) << method.name;
    EXPECT_EQ(frame.layers.pixels, lists.layers.pixels) << method.name;
    EXPECT_EQ(frame.coplanar.pixels, lists.coplanar.pixels) << method.name;
  }
}

// Pixels that a step of 1/128 to either side does not change are off edges.
TEST(GlOit, equalsTheTileMethodOffEdges) {
  const oit::Frame tile = drawnWith("tile"), before = drawnWith("tile", -1.0 / 128), after = drawnWith("tile", 1.0 / 128), lists = drawnWith("ll");
  int compared = 0, wrong = 0;
  for (std::size_t i = 0; i < tile.color.pixels.size(); ++i) {
    if (before.layers.pixels[i] != after.layers.pixels[i] || !(before.color.pixels[i] == after.color.pixels[i])) continue;
    compared += tile.layers.pixels[i] > 0;
    wrong += !(tile.color.pixels[i] == lists.color.pixels[i]) || tile.layers.pixels[i] != lists.layers.pixels[i] ||
             tile.coplanar.pixels[i] != lists.coplanar.pixels[i] || tile.ids.pixels[i] != lists.ids.pixels[i];
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(compared, 300);
}

}  // namespace
}  // namespace copeel::test
