// CSG through the gl back end: the same surfaces as the brute-force evaluator and the tile renderer find.
#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "core/error.h"
#include "core/gl/context.h"
#include "tests/csg_render/random_models.h"
#include "core/methods/method.h"
#include "tests/support/draw.h"
#include "tests/support/oracle.h"

namespace copeel::test {
namespace {

constexpr int kSize = 33;              // pixels
constexpr std::uint64_t kModels = 6;   // of each kind; every one is a context of its own

csg::RenderOptions with(std::string_view method) {
  csg::RenderOptions options;
  options.method = findMethod(method);
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

// Opaque, translucent, seen from within: what the fold needs of a method beyond its fragments' order.
std::vector<Case> casesOfEveryKind() {
  std::vector<Case> cases;
  for (const std::uint64_t seed : {1, 4}) cases.push_back(numbered(seed, [] { return Case{modelOf(randomTree(2)), randomView(kSize, kSize)}; }));
  cases.push_back(cases[0]);
  for (std::size_t leaf = 0; leaf < cases[2].model.leaves.size(); ++leaf) cases[2].model.leaves[leaf].color = glm::dvec4(0.2, 0.9, 0.5, leaf % 3 == 2 ? 1.0 : 0.3);
  cases.push_back({cases[1].model, lookAt({3, 3, 3}, {4.31, 3.17, 3.23}, kSize, kSize, 2.0 / kSize)});
  return cases;
}

csg::RenderOptions withDepthAndIds(std::string_view method) {
  csg::RenderOptions options = with(method);
  options.wantDepth = options.wantIds = true;
  return options;
}

TEST(GlCsg, robustMethodsGiveTheSameBytes) {
  for (const Case& c : casesOfEveryKind()) {
    csg::Renderer renderer(c.model, withDepthAndIds("ll"));
    const std::string expected = bytesOf(renderer.draw(c.view));
    for (const MethodInfo& method : methods()) {
      if (!method.draw || !method.robust) continue;
      renderer.setMethod(method, {});
      EXPECT_TRUE(bytesOf(renderer.draw(c.view)) == expected) << method.name;
      if (method.modifiers.find("+cull") == std::string_view::npos) continue;
      renderer.setMethod(method, {.cull = true});
      EXPECT_TRUE(bytesOf(renderer.draw(c.view)) == expected) << method.name << "+cull";
    }
  }
}

// An approximate method draws what it delivers, and says how much that is.
TEST(GlCsg, approximateMethodsSayWhatTheyLose) {
  const csg::Model twice = modelOf(unite(std::vector<Tree>(3, leaf(box({0, 0, 0}, {4, 4, 4})))));
  const View view = lookAt({12, 9, 7}, {2, 2, 2}, kSize, kSize, 0.02);
  csg::Renderer renderer(twice, withDepthAndIds("ll"));
  const csg::Frame whole = renderer.draw(view);
  renderer.measure();
  const std::uint64_t all = renderer.stats().fragments;
  EXPECT_EQ(renderer.stats().rh(), 1.0);
  const bool software = gl::Context().isSoftware();
  for (const MethodInfo& method : methods()) {
    if (!method.draw || method.robust) continue;
    if (method.name == "kb" && !software) continue;   // fragments meet in it there
    SCOPED_TRACE(method.name);
    renderer.setMethod(method, {.k = 2});
    const csg::Frame frame = renderer.draw(view);
    renderer.measure();
    const Stats& stats = renderer.stats();
    EXPECT_EQ(stats.fragments, all);
    // Of three coincident boxes those with a buffer of two a depth lose a third, those without two thirds; one buffer for all depths holds two of six.
    const bool twoADepth = method.name.find("fab") != std::string_view::npos || method.name.find("-kb") != std::string_view::npos;
    EXPECT_EQ(stats.fragmentsCaptured, twoADepth && method.name != "multi-kb" ? all / 3 * 2 : all / 3);
    // What is seen first is a face of each of them. Where fragments arrive in any order, srab may keep those behind.
    if (software || method.name != "srab") {
      EXPECT_EQ(frame.depth.pixels, whole.depth.pixels);
    }
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
