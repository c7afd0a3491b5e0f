// The pruned forest against the whole one: the leaves left out are constantly outside.
#include <random>

#include <gtest/gtest.h>

#include "apps/csg/gates.h"
#include "tests/support/models.h"

namespace copeel::test {
namespace {

using namespace csg;

Tree randomGates(std::mt19937& random, int depth) {
  const auto below = [&](int n) { return static_cast<int>(random() % n); };
  if (depth == 0 || below(4) == 0) return leaf(MeshPointer{});
  constexpr Operation kOperations[] = {Operation::Union, Operation::Intersection, Operation::Difference};
  Tree tree{kOperations[below(3)], {}, {}};
  for (int i = below(5); i > 0; --i) tree.children.push_back(randomGates(random, depth - 1));
  return tree;
}

bool valueOf(const Model& model, std::uint32_t index, const std::vector<bool>& inside) {
  const Node& node = model.nodes[index];
  if (node.operation == Operation::Leaf) return inside[node.leaf];
  if (node.childCount == 0) return false;
  bool all = true, any = false, later = false;
  for (std::uint32_t i = 0; i < node.childCount; ++i) {
    const bool value = valueOf(model, model.childIndices[node.firstChild + i], inside);
    all &= value, any |= value, later |= i > 0 && value;
  }
  if (node.operation == Operation::Difference) return valueOf(model, model.childIndices[node.firstChild], inside) && !later;
  return node.operation == Operation::Union ? any : all;
}

// Counts the inputs of every node of the pruned forest, children before parents, and reads the outputs.
std::vector<bool> outputsOf(const PrunedForest& pruned, const std::vector<std::uint32_t>& leaves, const std::vector<bool>& inside, std::size_t outputs) {
  const auto nodes = pruned.nodes();
  std::vector<std::int32_t> inputs(nodes.size(), 0);
  for (std::uint32_t local = 0; local < leaves.size(); ++local) {
    for (const PrunedForest::Use& use : pruned.uses(local)) inputs[use.node] += inside[leaves[local]] != use.negated;
  }
  std::vector<bool> result(outputs, false);
  for (std::size_t n = nodes.size(); n-- > 0;) {
    const bool value = inputs[n] >= nodes[n].threshold;
    if (nodes[n].parent != kNone) inputs[nodes[n].parent] += value != nodes[n].negated;
    if (nodes[n].output != kNone) result[nodes[n].output] = value;
  }
  return result;
}

TEST(Gates, prunedForestsGiveWhatTheWholeTreeGives) {
  std::mt19937 random(11);
  PrunedForest pruned;
  int risen = 0, dropped = 0;
  for (int round = 0; round < 3000; ++round) {
    Model model = modelOf(randomGates(random, 4));
    const auto count = static_cast<std::uint32_t>(model.leaves.size());
    if (random() % 3 == 0) model.highlight = {static_cast<std::uint32_t>(random() % model.nodes.size())};
    const bool section = random() % 4 == 0;
    const std::vector<std::uint32_t> sections = section ? std::vector<std::uint32_t>{count} : std::vector<std::uint32_t>{};
    const GateForest forest = buildGates(model, sections, std::vector<std::uint8_t>(count + section, 0), count + section);
    std::vector<std::uint32_t> leaves;
    for (std::uint32_t i = 0; i < count + section; ++i) {
      if (random() % 2) leaves.push_back(i);
    }
    pruned.prune(forest, leaves);
    for (std::uint32_t local = 0; local < leaves.size(); ++local) dropped += !pruned.matters(local);
    for (int state = 0; state < 8; ++state) {
      std::vector<bool> inside(count + section, false);
      for (std::uint32_t leaf : leaves) inside[leaf] = random() % 3 != 0;
      const std::vector<bool> results = outputsOf(pruned, leaves, inside, forest.outputs.size());
      for (std::size_t o = 0; o < forest.outputs.size(); ++o) {
        const bool overlay = forest.outputs[o].part > 0;
        bool expected = valueOf(model, overlay ? model.highlight[0] : model.root, inside);
        if (!overlay && section && inside[count]) expected = false;
        ASSERT_EQ(results[o], expected) << "round " << round;
        risen += expected;
      }
    }
  }
  EXPECT_GT(risen, 1000);
  EXPECT_GT(dropped, 1000);
}

TEST(Gates, theOpaqueShareTakesTranslucentLeavesThatAddAsEmpty) {
  const Model model = modelOf(unite({leaf(MeshPointer{}), subtract({leaf(MeshPointer{}), leaf(MeshPointer{})})}));
  const GateForest forest = buildGates(model, {}, {1, 0, 1}, 3);
  ASSERT_EQ(forest.outputs.size(), 2u);
  EXPECT_FALSE(forest.outputs[0].opaqueShare);
  EXPECT_TRUE(forest.outputs[1].opaqueShare);
  PrunedForest pruned;
  pruned.prune(forest, std::vector<std::uint32_t>{0, 1, 2});
  const auto of = [&](bool a, bool b, bool c) -> bool { return outputsOf(pruned, {0, 1, 2}, {a, b, c}, 2)[1]; };
  EXPECT_FALSE(of(true, false, false));
  EXPECT_TRUE(of(false, true, false));
  EXPECT_FALSE(of(false, true, true));   // a translucent cutter cuts
}

}  // namespace
}  // namespace copeel::test
