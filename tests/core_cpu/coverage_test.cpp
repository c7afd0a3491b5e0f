// Which samples a triangle covers: against exact 128-bit arithmetic on the snapped corners, and as closed surfaces.
#include <random>

#include <gtest/gtest.h>

#include "tests/support/meshes.h"
#include "tests/support/samples.h"
#include "tests/support/stacks.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

// One pixel of the image plane is one unit of x and y; the triangle soup lies in planes z = const.
View flatView(int width, int height) {
  View view;
  view.width = width;
  view.height = height;
  view.perspective = false;
  view.eye = {width * 0.5, -height * 0.5, 100};
  return view;
}

struct Compared {
  int triangles = 0, covered = 0;
};

// Every triangle of a soup covers the samples that its snapped corners hold, and no others.
Compared compareSamples(const Mesh& soup, const cpu::Frame& frame) {
  const Stacks stacks = stacksOf(frame);
  const int bits = frame.projection.grid.bits;
  Compared compared;
  for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
    const glm::ivec2* first = &frame.projection.vertices[3 * t];
    const glm::ivec2 corner[3] = {first[0], first[1], first[2]};
    if (corner[0].x == cpu::kOffGrid || corner[1].x == cpu::kOffGrid || corner[2].x == cpu::kOffGrid) continue;
    ++compared.triangles;
    for (int y = 0; y < frame.view.height; ++y) {
      for (int x = 0; x < frame.view.width; ++x) {
        bool found = false;
        for (const Group& group : stacks.at(x, y)) {
          for (const Crossing& c : group) found |= c.primitive == t;
        }
        const bool expected = covers(corner, std::int64_t{x} << bits, std::int64_t{y} << bits);
        EXPECT_EQ(found, expected) << "triangle " << t << " at " << x << ", " << y;
        if (found != expected) return compared;
        compared.covered += expected;
      }
    }
  }
  return compared;
}

struct Kind {
  const char* name;
  double size, around;   // pixels
};

class RandomTriangles : public testing::TestWithParam<std::tuple<glm::ivec2, Kind>> {};

TEST_P(RandomTriangles, coverExactlyTheSamplesOfTheirSnappedCorners) {
  const auto [image, kind] = GetParam();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-kind.around, 1 + kind.around), by(-kind.size, kind.size);
  Mesh mesh;
  for (unsigned i = 0; i < 60; ++i) {
    const glm::dvec3 center(at(random) * image.x, -at(random) * image.y, i);
    for (int k = 0; k < 3; ++k) {
      glm::dvec3 p = center + glm::dvec3(by(random), by(random), 0);
      // Half of them have corners on samples or pixel borders, where the rule matters.
      if (i % 2) p.x = std::round(p.x * 2) / 2, p.y = std::round(p.y * 2) / 2;
      mesh.vertices.push_back(p);
    }
    mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
  }
  const Scene scene({{share(mesh)}});
  const PlaneClasses planes(scene, 0);
  const View view = flatView(image.x, image.y);
  const cpu::Frame frame(scene, planes, view);
  const Compared compared = compareSamples(mesh, frame);
  // In an image of one pixel the large ones reach past the guard band, and the tiny ones miss the sample.
  EXPECT_TRUE(compared.triangles > 3 || image.x == 1);
  EXPECT_TRUE(compared.covered > 0 || image.x == 1);
}

INSTANTIATE_TEST_SUITE_P(Sizes, RandomTriangles,
                         testing::Combine(testing::Values(glm::ivec2(1, 1), glm::ivec2(17, 33), glm::ivec2(64, 64), glm::ivec2(130, 70)),
                                          testing::Values(Kind{"tiny", 0.6, 0}, Kind{"small", 3, 0.1}, Kind{"medium", 20, 0.2},
                                                          Kind{"large", 150, 0.5}, Kind{"needles", 80, 0})));

// Small triangles are taken in windows that have the shape of their bounds, large ones block by block: every shape around the change, laid
// across the borders of blocks and tiles, among them the slivers that cover nothing.
TEST(Coverage, boundsOfEveryShapeWhereverTheyLie) {
  std::mt19937 random(11);
  for (int width = 1; width <= 34; ++width) {
    Mesh mesh;
    const auto add = [&](glm::dvec2 from, glm::dvec2 to, glm::dvec2 third) {
      const auto first = static_cast<unsigned>(mesh.vertices.size());
      for (const glm::dvec2 p : {from, to, third}) mesh.vertices.emplace_back(p.x, -p.y, first);
      mesh.triangles.emplace_back(first, first + 1, first + 2);
    };
    for (int height = 1; height <= 34; ++height) {
      const glm::dvec2 at(random() % 40 + 0.3, random() % 30 + 0.3), size(width, height);
      add(at, at + glm::dvec2(size.x, 0), at + size);
      add(at, at + size, at + size * 0.5 + glm::dvec2(0.4, 0));
    }
    const Scene scene({{share(mesh)}});
    const PlaneClasses planes(scene, 0);
    const View view = flatView(70, 60);
    const Compared compared = compareSamples(mesh, cpu::Frame(scene, planes, view));
    ASSERT_FALSE(HasFailure()) << "width " << width;
    EXPECT_EQ(compared.triangles, 68);
    EXPECT_GT(compared.covered, 0);
  }
}

TEST(Coverage, cornersAreSnappedToTheNearestGridPoint) {
  const Scene scene({{share(sphere(10, 23, 11))}});
  const View view = lookAt({31, 22, 13}, {0, 0, 0}, 200, 100, 0.01);
  const cpu::Projection projection = cpu::project(scene, view);
  const double scale = std::ldexp(1.0, projection.grid.bits);
  EXPECT_EQ(projection.grid.bits, 12);
  for (std::uint32_t v = 0; v < projection.vertices.size(); ++v) {
    const glm::dvec3 p = scene.worldVertex(0, v) - view.eye;
    const double z = glm::dot(p, view.forward);
    const double x = glm::dot(p, view.right) / glm::dot(view.right, view.right) / z + view.width * 0.5 - 0.5;
    const double y = glm::dot(p, view.down) / glm::dot(view.down, view.down) / z + view.height * 0.5 - 0.5;
    EXPECT_NEAR(projection.vertices[v].x, x * scale, 0.501);
    EXPECT_NEAR(projection.vertices[v].y, y * scale, 0.501);
  }
}

// Signed crossings of each sample; every one must cancel.
void expectClosed(const Mesh& mesh, const View& view, std::size_t atLeastFragments) {
  const Scene scene({{share(mesh)}});
  const PlaneClasses planes(scene, 0);
  const cpu::Frame frame(scene, planes, view);
  const Stacks stacks = stacksOf(frame);
  for (std::size_t i = 0; i < stacks.pixels.size(); ++i) {
    int sum = 0;
    for (const Group& group : stacks.pixels[i]) {
      for (const Crossing& c : group) sum += c.side;
    }
    ASSERT_EQ(sum, 0) << "pixel " << i % view.width << ", " << i / view.width;
  }
  EXPECT_GE(stacks.fragments(), atLeastFragments);
}

TEST(Coverage, closedSurfacesCancelAtEverySample) {
  expectClosed(sphere(1, 200, 100), lookAt({3, 2, 1}, {0, 0, 0}, 129, 97, 0.005), 5000);       // triangles of a pixel and less
  expectClosed(sphere(1, 7, 5), lookAt({3, 2, 1}, {0, 0, 0}, 129, 97, 0.0005), 10000);          // far past the guard band
  expectClosed(box({-1, -1, -1}, {1, 1, 1}), lookAt({0, 0, 5}, {0, 0, 0}, 64, 64, 0.05, false), 100);   // edges through samples
  expectClosed(sphere(1, 40, 40), lookAt({0, 0, 5}, {0, 0, 0}, 64, 64, 1.0 / 16, false), 100);
  expectClosed(sphere(1e-3, 40, 40), lookAt({0, 0, 5}, {0, 0, 0}, 64, 64, 1.0 / 16), 0);        // a grid step or two in all
}

TEST(Coverage, imagesOfEveryShapeStayClosed) {
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(16384, 16), glm::ivec2(1, 16384), glm::ivec2(17, 33), glm::ivec2(16384, 1)}) {
    const double pixel = 1.5 / std::max(size.x, size.y);
    expectClosed(sphere(1, 60, 30), lookAt({3, 2, 1}, {0.001, 0.002, 0}, size.x, size.y, pixel), 2);
    expectClosed(sphere(1, 60, 30), lookAt({0.1, 3, 0.2}, {0.001, 0.002, 0}, size.x, size.y, pixel * 0.01, false), 2);
  }
}

// With the eye inside or beside a closed mesh that reaches behind it, all samples that see its sides sum to minus the winding at the eye.
TEST(Coverage, surfacesCutByTheNearPlaneStayWatertight) {
  const Scene scene({{share(sphere(1, 60, 30))}});
  const PlaneClasses planes(scene, 0);
  for (const auto& [eye, winding] : {std::pair(glm::dvec3(0.3, 0.2, 0.1), 1), std::pair(glm::dvec3(0.9, 0.2, 0.1), 1)}) {
    for (const double pixel : {0.002, 0.02, 0.5}) {
      const View view = lookAt(eye, {0, 0.3, 0.4}, 101, 103, pixel);
      const cpu::Frame frame(scene, planes, view);
      const Stacks stacks = stacksOf(frame);
      for (const auto& pixelStack : stacks.pixels) {
        int sum = 0;
        for (const Group& group : pixelStack) {
          for (const Crossing& c : group) sum += c.side;
        }
        ASSERT_EQ(sum, -winding);
      }
    }
  }
}

TEST(Coverage, aTessellatedRectangleCoversEachSampleOnce) {
  for (const int columns : {1, 3, 64, 130}) {
    Mesh mesh;
    const int rows = 50, width = 64, height = 64;
    for (int r = 0; r <= rows; ++r) {
      for (int c = 0; c <= columns; ++c) mesh.vertices.emplace_back(-0.5 + 65.0 * c / columns, 0.5 - 65.0 * r / rows, 0);
    }
    for (int r = 0; r < rows; ++r) {
      for (int c = 0; c < columns; ++c) {
        const unsigned a = r * (columns + 1) + c, b = a + 1, d = a + columns + 1, e = d + 1;
        if ((r + c) % 2) mesh.triangles.emplace_back(a, d, e), mesh.triangles.emplace_back(a, e, b);
        else mesh.triangles.emplace_back(a, d, b), mesh.triangles.emplace_back(b, d, e);
      }
    }
    const Scene scene({{share(mesh)}});
    const PlaneClasses planes(scene, 0);
    const View view = flatView(width, height);
    const cpu::Frame frame(scene, planes, view);
    const Stacks stacks = stacksOf(frame);
    for (const auto& pixel : stacks.pixels) {
      ASSERT_EQ(pixel.size(), 1u);
      ASSERT_EQ(pixel[0].size(), 1u);
      ASSERT_EQ(pixel[0][0].side, 1);
    }
  }
}

TEST(Coverage, whatLiesBehindTheEyeOrHasNoAreaCoversNothing) {
  Mesh mesh;
  mesh.vertices = {{-9, -9, 5}, {9, -9, 5}, {0, 9, 5}, {-9, -9, -5}, {0, 0, -5}, {9, 9, -5}, {1, 1, -5}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}, {4, 4, 6}, {6, 6, 6}};
  const Scene scene({{share(mesh)}});
  const PlaneClasses planes(scene, 0);
  const View view = lookAt({0, 0, 0}, {0, 0, -1}, 40, 40, 0.1);
  const cpu::Frame frame(scene, planes, view);
  EXPECT_EQ(stacksOf(frame).fragments(), 0u);
}

}  // namespace
}  // namespace copeel::test
