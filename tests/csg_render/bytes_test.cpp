// One picture, whatever the SIMD target, the number of threads, the run, and whether orders are filtered or decided exactly.
#include <set>

#include <gtest/gtest.h>

#include "core/cpu/kernels.h"
#include "tests/support/draw.h"
#include "tests/support/models.h"
#include "tests/support/views.h"

namespace copeel::test {
namespace {

struct Case {
  const char* name;
  csg::Model model;
  View view;
};

Tree turned(Tree tree) {
  if (tree.operation == csg::Operation::Leaf) tree.leaf.worldFromObject = rotation({10, 20, 30}) * tree.leaf.worldFromObject;
  for (Tree& child : tree.children) child = turned(child);
  return tree;
}

std::vector<Case> cases() {
  const Tree plate = subtract({leaf(box({0, 0, 0}, {10, 10, 2})), leaf(box({1, 1, 0}, {4, 4, 2})), leaf(box({5, 5, 1}, {10, 9, 2})),
                               leaf(prism({{7, 1}, {9, 1}, {9, 3}, {8, 4}, {7, 3}}, 2))});
  const Tree balls = unite({leaf(sphere(2, 40, 30), glm::dvec4(1, 0, 0, 0.4)), leaf(sphere(2, 40, 30), glm::dvec4(0, 0, 1, 0.7), translation({1, 0, 0})),
                            leaf(box({-1, -1, -1}, {1, 1, 1}), glm::dvec4(0, 1, 0, 1))});
  Tree copies = unite({});
  for (int i = 0; i < 64; ++i) copies.children.push_back(leaf(sphere(2, 20, 11)));
  // Deep enough for windows (core/cpu/block_window.h): unions that share the planes of their ends, every other one turned out of them.
  Tree products = intersect({});
  for (int i = 0; i < 10; ++i) {
    const std::optional<glm::dvec4> color = i % 3 == 1 ? std::optional(glm::dvec4(0, 0, 1, 0.5)) : std::nullopt;
    const glm::dmat4 turn = rotation({i % 2 * 180.0, i % 4 == 3 ? 20.0 * i : 0, 18.0 * i});
    products.children.push_back(unite({leaf(box({-3, -3, -2}, {3, 3, 2}), color, turn), leaf(prism({{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 4), {}, turn)}));
  }
  products = subtract({products, leaf(box({0, 0, -3}, {1, 1, 2}))});
  return {{"products of unions", modelOf(products), lookAt({9, 11, 14}, {0, 0, 0}, 44, 36, 0.02)},
          {"plate", modelOf(plate), lookAt({14, -9, 17}, {5, 5, 1}, 90, 70, 0.01)},
          {"turned plate", modelOf(turned(plate)), lookAt({4, -19, 17}, {3, 5, 1}, 90, 70, 0.01, true)},
          {"translucent balls", modelOf(balls), lookAt({5, 6, 7}, {0.5, 0, 0}, 90, 70, 0.008)},
          {"64 copies", modelOf(copies), lookAt({5, 6, 7}, {0, 0, 0}, 70, 70, 0.01)},
          {"from inside", modelOf(subtract({plate, leaf(sphere(1, 12, 9), {}, translation({3, 6, 1}))})), lookAt({3, 6, 1.1}, {9, 5, 1}, 70, 70, 0.02)},
          {"orthographic", modelOf(plate), lookAt({14, -9, 17}, {5, 5, 1}, 90, 70, 0.2, false)}};
}

TEST(Bytes, chooseSimdChangesTheTarget) {
  std::set<std::string> targets;
  std::string best;
  for (const char* name : {"scalar", "sse4", "best"}) {
    cpu::chooseSimd(name);
    targets.insert(best = cpu::simdInUse());
  }
  EXPECT_EQ(targets.size(), best == "SSE4" ? 2u : 3u);   // a processor may have no better one
#ifdef __x86_64__
  const bool avx512 = __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd") && __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
  if (avx512) {
    EXPECT_TRUE(best.starts_with("AVX3")) << best;   // Highway's name of AVX-512
  }
#endif
  // The least of them has no vectors: "SCALAR", or Highway's emulation of them by loops.
  cpu::chooseSimd("scalar");
  EXPECT_TRUE(std::set<std::string>({"SCALAR", "EMU128"}).contains(cpu::simdInUse())) << cpu::simdInUse();
  cpu::chooseSimd("best");
}

TEST(Bytes, everySimdTargetThreadCountAndRunGivesTheSame) {
  for (const Case& c : cases()) {
    for (const int samples : {1, 3}) {
      csg::RenderOptions options;
      options.samples = samples;
      options.threads = 1;
      cpu::chooseSimd("best");
      const std::string expected = bytesOf(draw(c.model, c.view, options).frame);
      for (const int threads : {1, 2, 3, 7}) {
        options.threads = threads;
        EXPECT_EQ(bytesOf(draw(c.model, c.view, options).frame), expected) << c.name << ", " << threads << " threads";
      }
      for (const char* name : {"scalar", "sse4", "avx2", "best"}) {
        cpu::chooseSimd(name);
        EXPECT_EQ(bytesOf(draw(c.model, c.view, options).frame), expected) << c.name << ", " << name;
      }
    }
  }
}

TEST(Bytes, everyOrderDecidedExactlyGivesTheSame) {
  for (Case& c : cases()) {
    c.view.width = c.view.height = 33;
    csg::RenderOptions options;
    const Drawing filtered = draw(c.model, c.view, options);
    options.decideAllExactly = true;
    const Drawing exact = draw(c.model, c.view, options);
    EXPECT_EQ(bytesOf(filtered.frame), bytesOf(exact.frame)) << c.name;
    EXPECT_GT(exact.stats.decidedExactly, filtered.stats.decidedExactly) << c.name;
  }
}

TEST(Bytes, planesThatCrossExactlyAtASampleAreDecidedExactly) {
  // The view axis meets the sample of the middle pixel; the two slanted faces cross there.
  const Mesh ramp = prism({{-2, -2}, {2, 2}, {-2, 2}}, 4);
  const Tree tree = intersect({leaf(ramp, {}, rotation({90, 0, 0})), leaf(ramp, {}, rotation({90, 0, 0}) * rotation({0, 180, 0}))});
  const View view = lookAt({0, -3, 10}, {0, -3, 0}, 33, 33, 0.1, false);
  const Tree crossing = unite({leaf(prism({{-2, -2}, {2, 2}, {-2, 2}}, 4), {}, glm::dmat4(1)), leaf(prism({{-2, 2}, {-2, -3}, {2, -2}}, 4))});
  const View level = lookAt({0, -9, 2}, {0, 0, 2}, 33, 33, 0.1);
  const Drawing drawing = draw(modelOf(crossing), level);
  EXPECT_GT(drawing.stats.decidedExactly, 0u);
  csg::RenderOptions options;
  options.decideAllExactly = true;
  EXPECT_EQ(bytesOf(drawing.frame), bytesOf(draw(modelOf(crossing), level, options).frame));
  EXPECT_EQ(bytesOf(draw(modelOf(tree), view).frame), bytesOf(draw(modelOf(tree), view, options).frame));
}

// A buffer as long as the deepest pixel loses nothing, wherever the eye is and whatever the tree; a short one says what it lost.
TEST(Bytes, longKBuffersGiveTheTilesPicture) {
  for (const Case& c : cases()) {
    const Drawing tile = draw(c.model, c.view);
    for (const char* method : {"kb", "k-plus"}) {
      csg::RenderOptions options;
      options.method = findMethod(method, "cpu");
      options.methodOptions.k = 256;
      const Drawing whole = draw(c.model, c.view, options);
      EXPECT_TRUE(bytesOf(whole.frame) == bytesOf(tile.frame)) << c.name;
      EXPECT_EQ(whole.stats.overflow, 0u) << c.name;
      options.methodOptions.k = 1;
      const Drawing one = draw(c.model, c.view, options);
      EXPECT_EQ(one.stats.fragments, whole.stats.fragments) << c.name;
      EXPECT_EQ(one.stats.fragmentsCaptured, one.stats.coveredPixels) << c.name;
      EXPECT_EQ(one.stats.fragmentsCaptured + one.stats.overflow, one.stats.fragments) << c.name;
    }
  }
}

}  // namespace
}  // namespace copeel::test
