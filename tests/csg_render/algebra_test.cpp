// What must hold whatever the picture: identities of sets, independence of order, trees of every shape.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "tests/csg_render/random_models.h"
#include "tests/support/draw.h"
#include "tests/support/oracle.h"

namespace copeel::test {
namespace {

constexpr int kSize = 40, kSmall = 24;   // pixels

void expectSameDepths(const Tree& a, const Tree& b, const View& view) {
  RC_ASSERT(differentPixels(draw(modelOf(a), view).frame, draw(modelOf(b), view).frame, false) == 0);
}

int covered(const csg::Frame& frame) {
  return static_cast<int>(std::count_if(frame.ids.pixels.begin(), frame.ids.pixels.end(), [](auto id) { return id != 0; }));
}

RC_GTEST_PROP(Algebra, identitiesOfOneSet, ()) {
  const Tree a = randomTree(2);
  const View view = randomView(kSize, kSize);
  expectSameDepths(unite({a, a}), a, view);
  expectSameDepths(intersect({a, a}), a, view);
  expectSameDepths(subtract({a, subtract({a, a})}), a, view);
  expectSameDepths(unite({subtract({a, a}), a}), a, view);
  RC_ASSERT(covered(draw(modelOf(subtract({a, a})), view).frame) == 0);
}

RC_GTEST_PROP(Algebra, rewritesOfTwoAndThreeSets, ()) {
  const Tree a = randomTree(1), b = randomTree(1), c = randomTree(1);
  const View view = randomView(kSize, kSize);
  expectSameDepths(unite({a, b, c}), unite({c, unite({b, a})}), view);
  expectSameDepths(intersect({a, b, c}), intersect({c, intersect({b, a})}), view);
  expectSameDepths(subtract({a, b, c}), subtract({a, unite({b, c})}), view);
  expectSameDepths(subtract({a, unite({b, c})}), intersect({subtract({a, b}), subtract({a, c})}), view);
  expectSameDepths(subtract({a, intersect({b, c})}), unite({subtract({a, b}), subtract({a, c})}), view);
  expectSameDepths(intersect({a, b}), subtract({a, subtract({a, b})}), view);
}

RC_GTEST_PROP(Algebra, theOrderOfTrianglesAndOfTheirCornersDoesNotChangeAPixel, ()) {
  const csg::Model model = modelOf(randomTree(3));
  csg::Model other = model;
  for (csg::Leaf& leaf : other.leaves) {
    Mesh mesh = *leaf.mesh;
    if (!mesh.facets.empty()) continue;
    std::reverse(mesh.triangles.begin(), mesh.triangles.end());
    for (glm::uvec3& t : mesh.triangles) t = {t.y, t.z, t.x};
    leaf.mesh = share(mesh);
  }
  const View view = randomView(kSize, kSize);
  const csg::Frame one = draw(model, view).frame, two = draw(other, view).frame;
  for (std::size_t i = 0; i < one.ids.pixels.size(); ++i) {
    RC_ASSERT(one.ids.pixels[i] == two.ids.pixels[i]);
    // Another representative of a class rounds its plane anew: an ulp of float.
    const float p = one.depth.pixels[i], q = two.depth.pixels[i];
    RC_ASSERT(p == q || std::nextafter(p, q) == q);
  }
}

RC_GTEST_PROP(Algebra, aMotionOfSceneAndCameraChangesNoOffEdgePixel, ()) {
  const csg::Model model = modelOf(randomTree(3));
  const View view = randomView(kSmall, kSmall);
  const glm::dmat4 m = translation({100, -50, 7}) * rotation({10, 20, 30});
  const csg::Frame one = draw(model, view).frame, two = draw(placed(model, m), moved(view, m)).frame;
  const Oracle oracle(model, view);
  for (int y = 0; y < kSmall; ++y) {
    for (int x = 0; x < kSmall; ++x) {
      if (!oracle.pixel(x, y).edge) RC_ASSERT(one.ids.at(x, y) == two.ids.at(x, y));
    }
  }
}

const View kFront = lookAt({3.1, 4.2, 20}, {2, 2, 0}, kSize, kSize, 0.01);
const Mesh kBlock = box({0, 0, 0}, {4, 4, 4});

int coveredBy(const Tree& tree) { return covered(draw(modelOf(tree), kFront).frame); }

TEST(Algebra, emptyOperandsMeanWhatSetsMean) {
  const Tree a = leaf(kBlock);
  const int all = coveredBy(a);
  ASSERT_GT(all, 100);
  EXPECT_EQ(coveredBy(unite({})), 0);
  EXPECT_EQ(coveredBy(intersect({})), 0);
  EXPECT_EQ(coveredBy(subtract({})), 0);
  EXPECT_EQ(coveredBy(unite({a, unite({})})), all);
  EXPECT_EQ(coveredBy(subtract({a})), all);
  EXPECT_EQ(coveredBy(subtract({a, unite({})})), all);
  EXPECT_EQ(coveredBy(subtract({unite({}), a})), 0);
  EXPECT_EQ(coveredBy(intersect({a})), all);
  EXPECT_EQ(coveredBy(intersect({a, unite({})})), 0);
  EXPECT_EQ(coveredBy(subtract({a, intersect({leaf(kBlock), unite({})})})), all);
  EXPECT_EQ(covered(draw(csg::Model{}, kFront).frame), 0);
}

TEST(Algebra, tenThousandLevelsOfEveryOperation) {
  // The tree is written down directly: addTree recurses.
  for (const auto operation : {csg::Operation::Union, csg::Operation::Intersection, csg::Operation::Difference}) {
    csg::Model model;
    model.leaves.push_back({share(kBlock), glm::dmat4(1), {}});
    model.nodes.push_back({csg::Operation::Leaf, 0, 0, 0});
    const MeshPointer other = share(operation == csg::Operation::Difference ? box({1, 1, 3}, {3, 3, 4}) : kBlock);
    for (std::uint32_t i = 1; i <= 10000; ++i) {
      model.leaves.push_back({other, glm::dmat4(1), {}});
      model.nodes.push_back({csg::Operation::Leaf, i, 0, 0});
      const auto last = static_cast<std::uint32_t>(model.nodes.size()) - 1, inner = last - 1;
      model.nodes.push_back({operation, 0, static_cast<std::uint32_t>(model.childIndices.size()), 2});
      model.childIndices.insert(model.childIndices.end(), {inner, last});
    }
    model.root = static_cast<std::uint32_t>(model.nodes.size()) - 1;
    const View view = lookAt({2.1, 2.2, 20}, {2.1, 2.2, 0}, 5, 5, 0.02);
    const csg::Frame frame = draw(model, view).frame;
    EXPECT_FLOAT_EQ(frame.depth.at(2, 2), operation == csg::Operation::Difference ? 17 : 16);
    EXPECT_EQ(frame.ids.at(2, 2), 10001);
  }
}

TEST(Algebra, oneMeshUsedTenThousandTimes) {
  Tree tree = unite({});
  const auto mesh = share(box({0, 0, 0}, {1, 1, 1}));
  for (int i = 0; i < 10000; ++i) tree.children.push_back(leaf(mesh, {}, translation({i % 100, i / 100, 0})));
  const View view = lookAt({50.2, 50.3, 200}, {50.2, 50.3, 0}, 60, 60, 0.01);
  const Drawing drawing = draw(modelOf(tree), view);
  EXPECT_EQ(drawing.stats.planeClasses, 204u);   // 101 + 101 + 2
  for (int y = 15; y < 45; ++y) {
    for (int x = 15; x < 45; ++x) EXPECT_FLOAT_EQ(drawing.frame.depth.at(x, y), 199);
  }
}

// Regression: a leaf used twice falls and rises within one crossing; that showed a wall where nothing changes.
TEST(Algebra, aNodeUsedTwiceShowsNoWallInsideItsUnion) {
  // (W - A) ∪ A, with one leaf A.
  csg::Model model;
  model.leaves = {{share(box({0, 0, 0}, {4, 4, 4})), glm::dmat4(1), {}}, {share(box({1, 1, 1}, {3, 3, 3})), glm::dmat4(1), {}}};
  model.nodes = {{csg::Operation::Leaf, 0, 0, 0}, {csg::Operation::Leaf, 1, 0, 0}, {csg::Operation::Difference, 0, 0, 2}, {csg::Operation::Union, 0, 2, 2}};
  model.childIndices = {0, 1, 2, 1};
  model.root = 3;
  for (csg::Leaf& leaf : model.leaves) leaf.color = glm::dvec4(1, 0, 0, 0.5);
  csg::RenderOptions options;
  options.lit = false;
  const csg::Frame twice = draw(model, kFront, options).frame;
  model.root = 0;
  const csg::Frame once = draw(model, kFront, options).frame;
  EXPECT_EQ(twice.color.pixels, once.color.pixels);
}

TEST(Algebra, mirroredSingularAndVanishingMatrices) {
  const Tree a = leaf(kBlock);
  const csg::Frame plain = draw(modelOf(a), kFront).frame;
  const csg::Frame mirrored = draw(modelOf(leaf(kBlock, {}, translation({4, 0, 0}) * scaling({-1, 1, 1}))), kFront).frame;
  EXPECT_EQ(differentPixels(plain, mirrored), 0);
  csg::RenderOptions positive;
  positive.inside = csg::InsideRule::Positive;
  EXPECT_EQ(differentPixels(plain, draw(modelOf(leaf(kBlock, {}, translation({4, 0, 0}) * scaling({-1, 1, 1}))), kFront, positive).frame), 0);
  for (const glm::dvec3& s : {glm::dvec3(1, 1, 0), glm::dvec3(0, 0, 1), glm::dvec3(0)}) {
    EXPECT_EQ(coveredBy(leaf(kBlock, {}, scaling(s))), 0);
    EXPECT_EQ(differentPixels(plain, draw(modelOf(subtract({a, leaf(kBlock, {}, scaling(s))})), kFront).frame), 0);
  }
}

}  // namespace
}  // namespace copeel::test
