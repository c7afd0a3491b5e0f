// Drawn frames against the brute-force evaluator: ids and depths of every off-edge pixel.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/csg_render/random_models.h"
#include "tests/support/draw.h"
#include "tests/support/oracle.h"

namespace copeel::test {
namespace {

constexpr int kSize = 33;   // pixels

RC_GTEST_PROP(Oracle, randomTreesOfBoxesOnAGridAgree, ()) {
  const csg::Model model = modelOf(randomTree(3));
  const View view = randomView(kSize, kSize);
  const Difference difference = compare(draw(model, view).frame, Oracle(model, view));
  RC_LOG() << difference;
  RC_ASSERT(difference.none());
}

RC_GTEST_PROP(Oracle, treesTurnedScaledAndMovedAgree, ()) {
  const double scale = *rc::gen::element(1e-3, 1.0, 1e3);
  const glm::dvec3 by = *rc::gen::element(glm::dvec3(0), glm::dvec3(1e3, -2e3, 5e2));
  const glm::dmat4 m = translation(by * scale) * rotation({10, 20, 30}) * scaling(glm::dvec3(scale));
  const csg::Model model = placed(modelOf(randomTree(3)), m);
  const View view = moved(randomView(kSize, kSize), m, scale);
  const Difference difference = compare(draw(model, view).frame, Oracle(model, view));
  RC_LOG() << difference;
  RC_ASSERT(difference.none());
}

RC_GTEST_PROP(Oracle, treesWithMirroredAndInsideOutLeavesAgreeUnderEveryRule, ()) {
  csg::Model model = modelOf(randomTree(2));
  for (csg::Leaf& leaf : model.leaves) {
    if (*rc::gen::arbitrary<bool>()) leaf.worldFromObject = translation({7, 0, 0}) * scaling({-1, 1, 1});
    if (*rc::gen::inRange(0, 3) == 0) leaf.mesh = share(flipped(*leaf.mesh));
  }
  csg::RenderOptions options;
  options.inside = *rc::gen::element(csg::InsideRule::NonZero, csg::InsideRule::Positive, csg::InsideRule::Odd);
  const View view = randomView(kSize, kSize);
  const Difference difference = compare(draw(model, view, options).frame, Oracle(model, view, options.inside));
  RC_LOG() << difference;
  RC_ASSERT(difference.none());
}

// The eye anywhere among the boxes, and on their faces, edges and corners where its coordinates are whole.
RC_GTEST_PROP(Oracle, eyesInsideAndOnSolidsAgree, ()) {
  const csg::Model model = modelOf(randomTree(3));
  glm::dvec3 eye;
  for (int axis = 0; axis < 3; ++axis) eye[axis] = *rc::gen::inRange(0, 15) * 0.5;
  const glm::dvec3 toward(*rc::gen::inRange(-10, 10) + 0.31, *rc::gen::inRange(-10, 10) + 0.17, *rc::gen::inRange(-10, 10) + 0.23);
  const View view = lookAt(eye, eye + toward, kSize, kSize, 2.0 / kSize);
  const Difference difference = compare(draw(model, view).frame, Oracle(model, view));
  RC_LOG() << difference;
  RC_ASSERT(difference.none());
}

TEST(Oracle, isNotBlind) {
  const csg::Model right = modelOf(subtract({leaf(box({0, 0, 0}, {4, 4, 4})), leaf(box({1, 1, 1}, {3, 3, 4}))}));
  const csg::Model wrong = modelOf(subtract({leaf(box({0, 0, 0}, {4, 4, 4})), leaf(box({1, 1, 1}, {3, 3, 3.999}))}));
  const View view = lookAt({2.1, 2.2, 20}, {2, 2, 0}, kSize, kSize, 0.01);
  EXPECT_TRUE(compare(draw(right, view).frame, Oracle(right, view)).none());
  const Difference difference = compare(draw(wrong, view).frame, Oracle(right, view));
  EXPECT_GT(difference.wrongIds, 20);
  EXPECT_GT(difference.wrongDepths, 20);
}

}  // namespace
}  // namespace copeel::test
