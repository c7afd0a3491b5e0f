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

// More vertices than one dispatch of groups projects, all but the last of which no triangle uses; and objects without any.
TEST(GlOit, aMeshOfFourMillionVertices) {
  const View view = lookAt({0.521, 0.532, 20}, {0.521, 0.532, 0}, 21, 21, 0.001);
  const auto drawn = [&](std::size_t unused) {
    const Mesh square = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
    Mesh large;
    large.vertices.assign(unused, glm::dvec3(0.5, 0.5, 0));
    large.vertices.insert(large.vertices.end(), square.vertices.begin(), square.vertices.end());
    for (const glm::uvec3& t : square.triangles) large.triangles.push_back(t + static_cast<std::uint32_t>(unused));
    oit::RenderOptions options;
    options.method = "ll";
    options.wantLayers = true;
    const MeshPointer none = share(Mesh{});
    return oit::Renderer({{none}, {none}, {share(large), {200, 30, 30, 0.5}, {}, glm::dmat4(1.0)}, {none}}, options).draw(view);
  };
  const oit::Frame small = drawn(0), large = drawn(4'200'000);
  EXPECT_EQ(large.layers.at(10, 10), 1);
  EXPECT_EQ(large.layers.pixels, small.layers.pixels);
  EXPECT_EQ(large.color.pixels, small.color.pixels);
}

// What a method delivers is counted beside it by one that takes any number of fragments.
TEST(GlOit, twentyOneThousandFragmentsInAPixelAreMeasured) {
  constexpr std::uint32_t kCount = 21'000;
  Mesh stack = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  stack.triangles.assign(kCount, {0, 1, 2});
  stack.facets.clear();
  oit::RenderOptions options;
  options.method = "sb";
  options.wantLayers = options.wantCoplanar = true;
  oit::Renderer renderer({{share(stack), {200, 30, 30, 1e-4f}, {}, glm::dmat4(1.0)}}, options);
  const oit::Frame frame = renderer.draw(lookAt({0.71, 0.32, 20}, {0.71, 0.32, 0}, 1, 1, 0.001));
  renderer.measure();
  EXPECT_EQ(frame.layers.at(0, 0), kCount);
  EXPECT_EQ(frame.coplanar.at(0, 0), kCount);
  EXPECT_EQ(renderer.stats().fragments, kCount);
  EXPECT_EQ(renderer.stats().fragmentsCaptured, kCount);
  EXPECT_EQ(renderer.stats().depthComplexityMax, kCount);
}

}  // namespace
}  // namespace copeel::test
