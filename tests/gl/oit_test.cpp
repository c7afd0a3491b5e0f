// Transparency through the gl back end: robust methods give the same picture to the byte, and the cpu's off edges.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "apps/oit/render_oit.h"
#include "core/methods/method.h"
#include "tests/support/gl_scenes.h"
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

const std::vector<Light> kLights = {{{1, 2, 3}, 0.7}, {{-2, 1, 0.5}, 0.4}};

oit::Frame drawnWith(std::string_view method, double offset = 0, std::string_view backend = "auto") {
  oit::RenderOptions options;
  options.method = findMethod(method, backend);
  options.methodOptions.k = 3;
  options.lights = kLights;
  options.wantDepth = options.wantIds = options.wantLayers = options.wantCoplanar = true;
  View view = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02);
  view.offset = {offset, offset};
  return oit::Renderer(bodies(), options).draw(view);
}

oit::RenderOptions listsWith(bool counts) {
  oit::RenderOptions options;
  options.method = findMethod("ll");
  options.lights = kLights;
  options.wantDepth = options.wantIds = true;
  options.wantLayers = options.wantCoplanar = counts;
  return options;
}

// Where nothing counts layers, the opaque body is drawn first and hides what is behind it: the same picture.
TEST(GlOit, robustMethodsGiveTheSameBytes) {
  const View view = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02);
  const oit::Frame lists = drawnWith("ll");
  for (const bool counts : {true, false}) {
    oit::Renderer renderer(bodies(), listsWith(counts));
    for (const MethodInfo& method : methods()) {
      if (!method.draw || !method.robust) continue;
      for (const bool cull : {false, true}) {
        if (cull && method.modifiers.find("+cull") == std::string_view::npos) continue;
        SCOPED_TRACE(std::string(method.name) + (cull ? "+cull" : "") + (counts ? "" : ", opaque first"));
        renderer.setMethod(method, {.cull = cull});
        const oit::Frame frame = renderer.draw(view);
        EXPECT_EQ(frame.color.pixels, lists.color.pixels);
        EXPECT_EQ(frame.depth.pixels, lists.depth.pixels);
        EXPECT_EQ(frame.ids.pixels, lists.ids.pixels);
        if (!counts) continue;
        EXPECT_EQ(frame.layers.pixels, lists.layers.pixels);
        EXPECT_EQ(frame.coplanar.pixels, lists.coplanar.pixels);
      }
    }
  }
}

// Six sheets of glass, an opaque one, and six more behind it: a pass for the opaque one, and none for what it hides. Glass in its plane is not hidden.
TEST(GlOit, whatIsBehindOpaqueOnesIsNotPeeled) {
  std::vector<oit::Part> parts;
  for (int i = 0; i < 13; ++i) parts.push_back({share(quad({-1, -1, -0.1 * i}, {1, -1, -0.1 * i}, {1, 1, -0.1 * i}, {-1, 1, -0.1 * i})), {20 * i, 99, 200 - 9 * i, i == 6 ? 1 : 0.25}, {}, glm::dmat4(1.0)});
  parts.push_back({parts[6].mesh, {255, 0, 0, 0.5}, {}, glm::dmat4(1.0)});
  const View view = lookAt({0.1, 0.2, 5}, {0, 0, 0}, 16, 12, 0.02);
  oit::Renderer counting(parts, listsWith(true)), hiding(parts, listsWith(false));
  const oit::Frame whole = counting.draw(view);
  for (const MethodInfo& method : methods()) {
    if (!method.draw) continue;
    SCOPED_TRACE(method.name);
    hiding.setMethod(method, {.k = 8});
    const oit::Frame frame = hiding.draw(view);
    if (method.robust || method.name == "k-plus" || method.name == "f2b-kb-zf") {
      EXPECT_EQ(frame.color.pixels, whole.color.pixels);
    }
    if (method.name == "f2b") {
      EXPECT_EQ(hiding.stats().passes, 1u + 7 + 1);
      counting.setMethod(method, {});
      counting.draw(view);
      EXPECT_EQ(counting.stats().passes, 13u + 1);
    }
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

// One name on both back ends is one picture, off edges.
// See GlBuffers.stacksOfAllHeightsSideBySide; here without states, and what a pixel of a second pass gives is kept.
TEST(GlOit, stacksOfAllHeightsEqualTheTileMethod) {
  const std::vector<oit::Part> parts = {{share(stairs()), {200, 120, 40, 0.03}, {}, glm::dmat4(1.0)}};
  for (const int rows : {24, 2}) {
    const View view = above(kStairs, rows, 1);
    oit::RenderOptions options;
    options.wantIds = options.wantLayers = options.wantCoplanar = true;
    options.method = findMethod("tile", "cpu");
    const oit::Frame expected = oit::Renderer(parts, options).draw(view);
    ASSERT_EQ(expected.layers.at(kStairs - 1, rows / 2), kStairs);
    for (const char* method : {"ll", "bun-ll", "fab", "sb", "multi-kb"}) {
      SCOPED_TRACE(fmt::format("{}, {} rows", method, rows));
      options.method = findMethod(method, "gl");
      const oit::Frame frame = oit::Renderer(parts, options).draw(view);
      if (findMethod(method, "gl")->robust) {
        EXPECT_EQ(frame.color.pixels, expected.color.pixels);
        EXPECT_EQ(frame.layers.pixels, expected.layers.pixels);
        EXPECT_EQ(frame.coplanar.pixels, expected.coplanar.pixels);
      }
      EXPECT_EQ(frame.ids.pixels, expected.ids.pixels);
    }
  }
}

TEST(GlOit, kBuffersOfBothBackEndsKeepTheSame) {
  const oit::Frame cpu = drawnWith("k-plus", 0, "cpu"), before = drawnWith("k-plus", -1.0 / 128, "cpu"), after = drawnWith("k-plus", 1.0 / 128, "cpu");
  const oit::Frame gl = drawnWith("k-plus", 0, "gl"), whole = drawnWith("tile");
  int compared = 0, wrong = 0, shortened = 0;
  for (std::size_t i = 0; i < cpu.color.pixels.size(); ++i) {
    shortened += cpu.layers.pixels[i] < whole.layers.pixels[i];
    if (before.layers.pixels[i] != after.layers.pixels[i] || !(before.color.pixels[i] == after.color.pixels[i])) continue;
    compared += cpu.layers.pixels[i] > 0;
    wrong += !(cpu.color.pixels[i] == gl.color.pixels[i]) || cpu.layers.pixels[i] != gl.layers.pixels[i] || cpu.coplanar.pixels[i] != gl.coplanar.pixels[i] ||
             cpu.ids.pixels[i] != gl.ids.pixels[i];
  }
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(compared, 300);
  EXPECT_GT(shortened, 100);   // K = 3 is too short for many pixels
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
    options.method = findMethod("ll");
    options.wantLayers = true;
    const oit::Part none{share(Mesh{}), {}, {}, glm::dmat4(1.0)};
    return oit::Renderer({none, none, {share(large), {200, 30, 30, 0.5}, {}, glm::dmat4(1.0)}, none}, options).draw(view);
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
  options.method = findMethod("sb");
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
