// CSG through the gl back end: the same surfaces as the brute-force evaluator and the tile renderer find.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/error.h"
#include "core/gl/context.h"
#include "tests/csg_render/random_models.h"
#include "tests/support/draw.h"
#include "tests/support/oracle.h"

namespace copeel::test {
namespace {

constexpr int kSize = 33;              // pixels
constexpr std::uint64_t kModels = 6;   // of each kind; every one is a context of its own

csg::RenderOptions with(std::string_view method) {
  csg::RenderOptions options;
  options.method = method;
  return options;
}

struct Case {
  csg::Model model;
  View view;
};

// Models by number: the same in every run.
template <class Make>
Case numbered(std::uint64_t seed, Make make) { return rc::gen::exec(make)(rc::Random(seed), 100).value(); }

TEST(GlCsg, randomTreesOfBoxesOnAGridAgree) {
  for (std::uint64_t seed = 0; seed < kModels; ++seed) {
    const Case c = numbered(seed, [] { return Case{modelOf(randomTree(3)), randomView(kSize, kSize)}; });
    const Difference difference = compare(draw(c.model, c.view, with("ll")).frame, Oracle(c.model, c.view));
    EXPECT_TRUE(difference.none()) << seed << ": " << difference;
  }
}

// The eye anywhere among the boxes, and on their faces, edges and corners where its coordinates are whole.
TEST(GlCsg, eyesInsideAndOnSolidsAgree) {
  for (std::uint64_t seed = 0; seed < kModels; ++seed) {
    const Case c = numbered(seed, [] {
      glm::dvec3 eye;
      for (int axis = 0; axis < 3; ++axis) eye[axis] = *rc::gen::inRange(0, 15) * 0.5;
      const glm::dvec3 toward(*rc::gen::inRange(-10, 10) + 0.31, *rc::gen::inRange(-10, 10) + 0.17, *rc::gen::inRange(-10, 10) + 0.23);
      return Case{modelOf(randomTree(3)), lookAt(eye, eye + toward, kSize, kSize, 2.0 / kSize)};
    });
    const Difference difference = compare(draw(c.model, c.view, with("ll")).frame, Oracle(c.model, c.view));
    EXPECT_TRUE(difference.none()) << seed << ": " << difference;
  }
}

// Translucent leaves: more surfaces in a pixel, blended by the same code as the cpu's.
TEST(GlCsg, translucentTreesEqualTheTileRendererOffEdges) {
  for (std::uint64_t seed = 0; seed < kModels; ++seed) {
    Case c = numbered(seed, [] { return Case{modelOf(randomTree(2)), randomView(kSize, kSize)}; });
    for (std::size_t leaf = 0; leaf < c.model.leaves.size(); ++leaf) {
      c.model.leaves[leaf].color = glm::dvec4(0.2 * double(leaf % 5), 0.9 - 0.2 * double(leaf % 4), 0.5, leaf % 3 == 2 ? 1.0 : 0.3);
    }
    const Drawing cpu = draw(c.model, c.view), gl = draw(c.model, c.view, with("ll"));
    const Oracle oracle(c.model, c.view);
    int wrong = 0;
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) wrong += !oracle.pixel(x, y).edge && cpu.frame.color.at(x, y) != gl.frame.color.at(x, y);
    }
    EXPECT_EQ(wrong, 0) << seed;
  }
}

// 7,000 leaves are more turns of loops than llvmpipe allows a shader, and it would leave the rest of a pixel's state undone: a picture that looks right.
TEST(GlCsg, aModelTooLargeForTheDriversLoopsIsRefused) {
  const MeshPointer cube = share(box({0, 0, 0}, {1, 1, 1}));
  const auto leaves = [&](int count) {
    std::vector<Tree> all;
    for (int i = 0; i < count; ++i) all.push_back(leaf(cube, {}, translation({2.0 * (i % 80), 2.0 * (i / 80), 0})));
    return modelOf(unite(all));
  };
  const View view = lookAt({80.37, 60.41, 300}, {80.37, 60.41, 0}, 9, 9, 0.05);
  const bool software = gl::Context().isSoftware();   // at an end before there is another
  const csg::Model some = leaves(1000), tooMany = leaves(7000);
  EXPECT_EQ(draw(some, view, with("ll")).frame.ids.pixels, draw(some, view).frame.ids.pixels);
  csg::Renderer renderer(tooMany, with("ll"));
  try {
    renderer.draw(view);
    if (software) ADD_FAILURE() << "drawn";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Machine) << error.what();
  }
}

}  // namespace
}  // namespace copeel::test
