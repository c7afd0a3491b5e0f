// Building and pruning of gates; no recursion, as trees may be 10,000 deep.
#include "apps/csg/gates.h"

#include <algorithm>
#include <limits>

namespace copeel::csg {
namespace {

// Copies the tree below `root` into gates. Leaves for which `skip` holds count as empty.
class TreeCopier {
 public:
  TreeCopier(const Model& model, GateForest& forest, std::vector<std::vector<LeafUse>>& uses)
      : model_(model), forest_(forest), uses_(uses) {}

  // Returns the top gate, a union of the root (and less the sections).
  std::uint32_t copy(std::uint32_t root, std::span<const std::uint32_t> sections, const std::vector<std::uint8_t>* skip) {
    struct Visit {
      std::uint32_t node, parent;
      bool negated, cuts;
    };
    std::vector<Visit> stack;
    // Gates are numbered parents first here, and reversed at the end.
    const std::uint32_t top = add(kNone, false, true);
    forest_.gates[top].positiveInputs = 1;
    for (std::uint32_t leaf : sections) use(leaf, top, true, true);
    stack.push_back({root, top, false, false});
    while (!stack.empty()) {
      const Visit at = stack.back();
      stack.pop_back();
      const Node& node = model_.nodes[at.node];
      if (node.operation == Operation::Leaf) {
        if (skip && (*skip)[node.leaf] && !at.cuts) continue;
        use(node.leaf, at.parent, at.negated, at.cuts);
        continue;
      }
      const bool difference = node.operation == Operation::Difference;
      const bool all = difference || node.operation == Operation::Intersection;
      const std::uint32_t gate = add(at.parent, at.negated, all);
      forest_.gates[gate].positiveInputs = difference ? std::min(node.childCount, 1u) : node.childCount;
      if (all && node.childCount == 0) forest_.gates[gate].positiveInputs = 1;   // an empty intersection is empty: it waits in vain
      for (std::uint32_t i = node.childCount; i-- > 0;) {
        const bool negated = difference && i > 0;
        stack.push_back({model_.childIndices[node.firstChild + i], gate, negated, at.cuts != negated});
      }
    }
    return top;
  }

 private:
  std::uint32_t add(std::uint32_t parent, bool negated, bool all) {
    forest_.gates.push_back({parent, negated, all, 0, kNone});
    return static_cast<std::uint32_t>(forest_.gates.size() - 1);
  }
  void use(std::uint32_t leaf, std::uint32_t gate, bool negated, bool cuts) {
    uses_[leaf].push_back({gate, negated});
    forest_.cuts[leaf] = cuts;
  }

  const Model& model_;
  GateForest& forest_;
  std::vector<std::vector<LeafUse>>& uses_;
};

}  // namespace

GateForest buildGates(const Model& model, std::span<const std::uint32_t> sections, const std::vector<std::uint8_t>& translucent,
                      std::uint32_t leafCount) {
  GateForest forest;
  forest.cuts.assign(leafCount, 0);
  forest.firstSection = static_cast<std::uint32_t>(model.leaves.size());
  std::vector<std::vector<LeafUse>> uses(leafCount);
  TreeCopier copier(model, forest, uses);
  const auto addOutput = [&](std::uint32_t root, std::uint32_t part, bool opaqueShare, bool cutBySections) {
    const std::uint32_t top = copier.copy(root, cutBySections ? sections : std::span<const std::uint32_t>{},
                                          opaqueShare ? &translucent : nullptr);
    forest.gates[top].output = static_cast<std::uint32_t>(forest.outputs.size());
    forest.outputs.push_back({top, part, opaqueShare});
  };
  std::uint32_t part = 0;
  for (const auto* overlays : {&model.background, &model.highlight}) {
    for (std::uint32_t root : *overlays) addOutput(root, ++part, false, false);
  }
  if (model.root != kNoNode) {
    addOutput(model.root, 0, false, true);
    if (std::any_of(translucent.begin(), translucent.end(), [](auto t) { return t != 0; })) addOutput(model.root, 0, true, true);
  }

  // Children before parents.
  const auto last = static_cast<std::uint32_t>(forest.gates.size()) - 1;
  const auto flip = [last](std::uint32_t gate) { return gate == kNone ? kNone : last - gate; };
  std::reverse(forest.gates.begin(), forest.gates.end());
  for (Gate& gate : forest.gates) gate.parent = flip(gate.parent);
  for (Output& output : forest.outputs) output.gate = flip(output.gate);
  forest.firstUse.push_back(0);
  for (const auto& list : uses) {
    for (const LeafUse& use : list) forest.uses.push_back({flip(use.gate), use.negated});
    forest.firstUse.push_back(static_cast<std::uint32_t>(forest.uses.size()));
  }
  return forest;
}

void PrunedForest::prune(const GateForest& forest, std::span<const std::uint32_t> leaves) {
  if (live_.size() != forest.gates.size()) live_.assign(forest.gates.size(), {});
  ++epoch_;
  markAncestors(forest, leaves);
  settleGates(forest);
  numberGates(forest);

  // Uses whose way up is open.
  uses_.clear();
  firstUse_.clear();
  for (std::uint32_t leaf : leaves) {
    firstUse_.push_back(static_cast<std::uint32_t>(uses_.size()));
    for (std::uint32_t u = forest.firstUse[leaf]; u < forest.firstUse[leaf + 1]; ++u) {
      const LeafUse& use = forest.uses[u];
      const std::uint32_t node = live_[use.gate].node;
      if (node == kNone) continue;
      const bool negated = use.negated != live_[use.gate].inverts;
      if (negated) ++nodes_[node].threshold, ++nodes_[node].initial;
      uses_.push_back({node, negated});
    }
  }
  firstUse_.push_back(static_cast<std::uint32_t>(uses_.size()));
  countLeastEntries();
}

void PrunedForest::markAncestors(const GateForest& forest, std::span<const std::uint32_t> leaves) {
  marked_.clear();
  for (std::uint32_t leaf : leaves) {
    for (std::uint32_t u = forest.firstUse[leaf]; u < forest.firstUse[leaf + 1]; ++u) {
      for (std::uint32_t g = forest.uses[u].gate; g != kNone && live_[g].epoch != epoch_; g = forest.gates[g].parent) {
        live_[g] = {};
        live_[g].epoch = epoch_;
        marked_.push_back(g);
      }
      Live& live = live_[forest.uses[u].gate];
      ++(forest.uses[u].negated ? live.negative : live.positive);
    }
  }
  std::sort(marked_.begin(), marked_.end());
}

// Bottom up: a gate that cannot become true leaves its parent one positive input short.
void PrunedForest::settleGates(const GateForest& forest) {
  for (std::uint32_t g : marked_) {
    const Gate& gate = forest.gates[g];
    Live& live = live_[g];
    live.possible = gate.all ? live.positive == gate.positiveInputs : live.positive > 0;
    if (!live.possible || gate.parent == kNone) continue;
    ++(gate.negated ? live_[gate.parent].negative : live_[gate.parent].positive);
  }
}

// Top down: a gate counts when it is possible and its parent counts. A gate with a single input passes it on.
void PrunedForest::numberGates(const GateForest& forest) {
  nodes_.clear();
  for (auto at = marked_.rbegin(); at != marked_.rend(); ++at) {
    const Gate& gate = forest.gates[*at];
    Live& live = live_[*at];
    const Live* parent = gate.parent == kNone ? nullptr : &live_[gate.parent];
    if (!live.possible || (parent && parent->node == kNone)) continue;
    const bool negated = parent && gate.negated != parent->inverts;
    if (live.positive + live.negative == 1 && gate.output == kNone) {
      live.node = parent->node;
      live.inverts = negated;
      continue;
    }
    live.node = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({parent ? parent->node : kNone, gate.all ? static_cast<std::int32_t>(live.positive) : 1, 0, gate.output, negated});
    // A negated input is true while its leaves are outside: it raises the threshold and the initial count alike.
    if (negated) ++nodes_[parent->node].threshold, ++nodes_[parent->node].initial;
  }
}

// A gate that lacks one input takes the cheapest, one that lacks all of them takes their sum.
void PrunedForest::countLeastEntries() {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  entries_.clear();
  for (const Node& node : nodes_) entries_.push_back(node.threshold - node.initial == 1 ? kNever : 0);
  const auto feed = [&](std::uint32_t node, double cost) {
    const bool one = nodes_[node].threshold - nodes_[node].initial == 1;
    entries_[node] = one ? std::min(entries_[node], cost) : entries_[node] + cost;
  };
  for (const Use& use : uses_) {
    if (!use.negated) feed(use.node, 1);
  }
  leastEntries_ = kNever;
  for (std::size_t n = nodes_.size(); n-- > 0;) {
    if (nodes_[n].parent == kNone) leastEntries_ = std::min(leastEntries_, entries_[n]);
    else if (!nodes_[n].negated) feed(nodes_[n].parent, entries_[n]);
  }
}

}  // namespace copeel::csg
