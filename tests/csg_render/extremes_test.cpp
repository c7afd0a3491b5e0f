// Coordinates at the ends of what a double holds: a picture or nothing, but never an abort or a NaN.
#include <gtest/gtest.h>

#include "core/error.h"
#include "tests/support/draw.h"
#include "tests/support/models.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

void expectNoNan(const csg::Model& model, const View& view) {
  for (const bool exactly : {false, true}) {
    csg::RenderOptions options;
    options.decideAllExactly = exactly;
    for (float depth : draw(model, view, options).frame.depth.pixels) ASSERT_FALSE(std::isnan(depth));
  }
}

TEST(Extremes, scenesOfAnySizeAreDrawn) {
  for (const double size : {1e-300, 1e-150, 1e-42, 1e-30, 1e-6, 1e6, 1e25, 9e29}) {
    const csg::Model model = modelOf(subtract({leaf(box(glm::dvec3(-size), glm::dvec3(size))), leaf(box({0, 0, 0}, glm::dvec3(size)))}));
    for (const bool perspective : {true, false}) {
      const View view = lookAt(glm::dvec3(3, 2, 5) * size, {0, 0, 0}, 17, 17, perspective ? 0.05 : 0.2 * size, perspective);
      SCOPED_TRACE(size);
      expectNoNan(model, view);
      if (size > 1e-20) {
        EXPECT_NE(draw(model, view).frame.ids.at(8, 8), 0);
      }
    }
  }
}

TEST(Extremes, coordinatesBeyondTheLargestAreRefused) {
  for (const double wild : {1.1e30, 1e39, 1e200, 1e308, -1e308, double(INFINITY), double(NAN)}) {
    Mesh mesh = box({-1, -1, -1}, {1, 1, 1}, false);
    mesh.vertices[7].x = wild;
    try {
      draw(modelOf(leaf(mesh)), lookAt({3, 2, 5}, {0, 0, 0}, 17, 17, 0.05));
      ADD_FAILURE() << wild << " was drawn";
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ExitCode::Input);
    }
    mesh.triangles.clear();   // a vertex of no triangle matters to nobody
    expectNoNan(modelOf(leaf(mesh)), lookAt({3, 2, 5}, {0, 0, 0}, 17, 17, 0.05));
  }
}

TEST(Extremes, aWildVertexIsNoDisaster) {
  for (const double wild : {1e15, -1e30, 5e-324}) {
    Mesh mesh = box({-1, -1, -1}, {1, 1, 1}, false);
    mesh.vertices[7].x = wild;
    for (const bool perspective : {true, false}) {
      expectNoNan(modelOf(unite({leaf(mesh), leaf(box({0, 0, 0}, {1, 1, 1}))})), lookAt({3, 2, 5}, {0, 0, 0}, 17, 17, perspective ? 0.05 : 0.2, perspective));
    }
  }
}

}  // namespace
}  // namespace copeel::test
