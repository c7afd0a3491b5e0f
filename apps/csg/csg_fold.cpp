// The fold's tile and pixel state; see csg_fold.h for the rules.
#include "apps/csg/csg_fold.h"

#include <algorithm>
#include <limits>

namespace copeel::csg {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

}  // namespace

bool CsgFold::beginTile(cpu::Tile& tile) {
  listLeaves(tile);
  if (leaves_.empty()) return false;
  pruned_.prune(forest_, leaves_);
  if (pruned_.nodes().empty()) return false;
  tileNeedsStack_ = false;
  for (std::uint32_t i = 0; i < tile.objects.size(); ++i) {
    tile.objects[i].keep = pruned_.matters(i);
    tileNeedsStack_ |= eye_.any && tile.objects[i].keep && eye_.fromStack[leaves_[i]];
  }
  setInitialState();
  setInitialWindows();
  return true;
}

// Where in depth a leaf can be inside, given where it has faces: one that is not closed may be left open for good.
cpu::DepthRange CsgFold::windowOf(std::uint32_t leaf, const cpu::DepthRange& range) const {
  return {range.least, closed_[leaves_[leaf]] ? range.most : kFar};
}

void CsgFold::setInitialWindows() {
  initialWindows_.clear();
  for (const PrunedForest::Node& node : pruned_.nodes()) {
    const std::int32_t lacking = node.threshold - node.initial;
    initialWindows_.push_back({lacking == 1 ? cpu::DepthRange{} : cpu::DepthRange{-kFar, kFar}, lacking, lacking != 1});
  }
}

// Where in depth a gate can be true at all: a union where any input can, an intersection where all can.
inline void CsgFold::feed(std::uint32_t gate, const cpu::DepthRange& input) {
  GateWindow& window = windows_[gate];
  --window.lacking;
  if (window.all) window.range = {std::max(window.range.least, input.least), std::min(window.range.most, input.most)};
  else window.range.add(input.least, input.most);
}

inline void CsgFold::feedUses(std::uint32_t leaf, const cpu::DepthRange& window) {
  for (const PrunedForest::Use& use : pruned_.uses(leaf)) {
    if (!use.negated) feed(use.node, window);
  }
}

// Bottom up, after the leaves have been fed. Returns where any result can be true.
cpu::DepthRange CsgFold::findWindows() {
  const auto nodes = pruned_.nodes();
  cpu::DepthRange any;
  for (std::size_t n = nodes.size(); n-- > 0;) {
    GateWindow& window = windows_[n];
    if (window.lacking > 0 || window.range.empty()) window.range = {};
    else if (nodes[n].parent == kNone) any.add(window.range.least, window.range.most);
    else if (!nodes[n].negated) feed(nodes[n].parent, window.range);
  }
  return any;
}

bool CsgFold::mayShow(std::span<const cpu::DepthRange> ranges) {
  if (eye_.any) return true;   // some leaf is inside from the start
  windows_ = initialWindows_;
  for (std::uint32_t leaf = 0; leaf < ranges.size(); ++leaf) {
    if (!ranges[leaf].empty()) feedUses(leaf, windowOf(leaf, ranges[leaf]));
  }
  return !findWindows().empty();
}

// A leaf whose crossings sum to zero is left for good behind the last; those that lie too deep to be here do not matter.
cpu::DepthRange CsgFold::window(const PixelStack& stack) {
  if (eye_.any) return {-kFar, kFar};
  windows_ = initialWindows_;
  for (std::uint32_t i = 0; i < stack.count;) {
    const std::uint32_t leaf = stack.slots[stack.slot(i)].object;
    cpu::DepthRange range;
    std::int32_t winding = 0;
    for (; i < stack.count && stack.slots[stack.slot(i)].object == leaf; ++i) {
      const cpu::DepthRange depth = stack.depth(i);
      range.add(depth.least, depth.most);
      winding += stack.slots[stack.slot(i)].side;
    }
    feedUses(leaf, {range.least, winding == 0 ? range.most : kFar});
  }
  return findWindows();
}

// Top down, where the windows of the gates matter. A leaf that can only be inside elsewhere is dropped: it is outside wherever anyone looks.
double CsgFold::narrowTile(cpu::Tile& tile) {
  if (eye_.any) return kFar;
  windows_ = initialWindows_;
  tile.findRanges();
  for (std::uint32_t leaf = 0; leaf < tile.objects.size(); ++leaf) {
    if (!tile.objects[leaf].range.empty()) feedUses(leaf, windowOf(leaf, tile.objects[leaf].range));
  }
  const double farthest = findWindows().most;
  const auto nodes = pruned_.nodes();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].parent == kNone) continue;
    const cpu::DepthRange &own = windows_[n].range, &above = windows_[nodes[n].parent].range;
    windows_[n].range = {std::max(own.least, above.least), std::min(own.most, above.most)};
  }
  for (std::uint32_t leaf = 0; leaf < tile.objects.size(); ++leaf) {
    if (!tile.objects[leaf].keep) continue;
    const cpu::DepthRange own = windowOf(leaf, tile.objects[leaf].range);
    bool matters = false;
    for (const PrunedForest::Use& use : pruned_.uses(leaf)) {
      const cpu::DepthRange& window = windows_[use.node].range;
      matters |= !window.empty() && own.least <= window.most && window.least <= own.most;
    }
    tile.objects[leaf].keep = matters;
  }
  return farthest;
}

void CsgFold::listLeaves(const cpu::Tile& tile) {
  leaves_.clear();
  for (const cpu::TileObject& object : tile.objects) leaves_.push_back(object.object);
  if (!eye_.any) return;
  const std::size_t own = leaves_.size();
  for (std::uint32_t leaf = 0; leaf < eye_.constant.size(); ++leaf) {
    const bool shown = std::binary_search(leaves_.begin(), leaves_.begin() + static_cast<std::ptrdiff_t>(own), leaf);
    if (eye_.constant[leaf] != 0 && !shown) leaves_.push_back(leaf);
  }
}

// The state in which every pixel of the tile starts.
void CsgFold::setInitialState() {
  gates_.clear();
  topOfOutput_.assign(forest_.outputs.size(), kNone);
  for (const PrunedForest::Node& node : pruned_.nodes()) {
    if (node.output != kNone) topOfOutput_[node.output] = static_cast<std::uint32_t>(gates_.size());
    gates_.push_back({node.threshold - node.initial, node.parent, node.output, node.negated});
  }
  states_.clear();
  for (std::uint32_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    const auto uses = pruned_.uses(leaf);
    states_.push_back(uses.empty() ? LeafState{0, kNone, false, false} : LeafState{0, uses[0].node, uses[0].negated, uses.size() > 1});
  }
  change_.assign(leaves_.size(), 0);
  if (eye_.any) {
    for (std::uint32_t leaf = 0; leaf < leaves_.size(); ++leaf) {
      if (eye_.constant[leaves_[leaf]] != 0) addWinding(leaf, eye_.constant[leaves_[leaf]]);
    }
  }
  risen_.clear();
  fallen_.clear();
  initialGates_ = gates_;
  initialStates_ = states_;
  dirty_ = false;
}

void CsgFold::beginPixel(const PixelStack& stack) {
  slots_ = stack.slots;
  if (dirty_) {
    std::copy(initialStates_.begin(), initialStates_.end(), states_.begin());
    std::copy(initialGates_.begin(), initialGates_.end(), gates_.begin());
    dirty_ = false;
  }
  groupCount_ = 0;
  surfaces_.clear();
  hasColor_ = enough_ = false;
  if (tileNeedsStack_) startInsideStack(stack);
  for (std::uint32_t slot : stack.before) addWinding(slots_[slot].object, slots_[slot].side);   // no result turns in front of the window
}

// A closed leaf around the start of the ray: its crossings sum to minus the winding number there.
void CsgFold::startInsideStack(const PixelStack& stack) {
  for (std::uint32_t i = 0; i < stack.count; ++i) {
    const cpu::TileSlot& slot = slots_[stack.slot(i)];
    if (eye_.fromStack[leaves_[slot.object]]) addWinding(slot.object, -slot.side);
  }
  risen_.clear();
  fallen_.clear();
}

inline void CsgFold::addWinding(std::uint32_t leaf, std::int32_t change) {
  LeafState& state = states_[leaf];
  const bool before = inside(state.winding), after = inside(state.winding + change);
  state.winding += change;
  dirty_ = true;
  if (before == after || state.gate == kNone) return;
  climb(state.gate, after != state.negated);
  if (!state.hasMoreUses) return;
  for (const PrunedForest::Use& use : pruned_.uses(leaf).subspan(1)) climb(use.node, after != use.negated);
}

// An input of a gate became `value`; the change travels up to the first gate that holds.
inline void CsgFold::climb(std::uint32_t index, bool value) {
  for (;;) {
    Gate& gate = gates_[index];
    const bool was = gate.isTrue();
    gate.lacking -= value ? 1 : -1;
    const bool is = gate.isTrue();
    if (was == is) return;
    if (gate.output != kNone) noteToggle(gate.output, is);
    if (gate.parent == kNone) return;
    value = is != gate.negated;
    index = gate.parent;
  }
}

// What a result was before the group shows in its first change: a leaf of several uses may make it fall and rise again.
void CsgFold::noteToggle(std::uint32_t output, bool rises) {
  for (const auto* known : {&risen_, &fallen_}) {
    if (std::find(known->begin(), known->end(), output) != known->end()) return;
  }
  (rises ? risen_ : fallen_).push_back(output);
}

bool CsgFold::closeGroup() {
  if (groupCount_ > 1) before_ = gates_;
  for (std::size_t i = 0; i < groupCount_; ++i) addWinding(slots_[group_[i]].object, slots_[group_[i]].side);
  if (!risen_.empty()) showRisen();
  fallen_.clear();
  groupCount_ = 0;
  return enough_;
}

void CsgFold::showRisen() {
  if (risen_.size() > 1) std::sort(risen_.begin(), risen_.end());
  for (std::uint32_t output : risen_) {
    // Only a result that was false before the whole group and is true after it shows a surface.
    if (gates_[topOfOutput_[output]].isTrue() && !enough_) showSurface(output, groupCount_ == 1 ? group_[0] : showingFace(output));
  }
  risen_.clear();
}

void CsgFold::showSurface(std::uint32_t output, std::uint32_t slot) {
  const cpu::TileSlot& face = slots_[slot];
  std::uint32_t leaf = leaves_[face.object];
  if (leaf >= forest_.firstSection) leaf = partBehindCap(output, leaf);
  const Output& result = forest_.outputs[output];
  const double alpha = alpha_(context_, leaf, result.part);
  // A translucent face of the opaque share has been blended as a face of the whole.
  if (alpha <= 0 || (alpha < 1 && result.opaqueShare)) return;
  surfaces_.push_back({face.primitive, face.planeClass, leaf, result.part});
  enough_ = alpha >= 1;
}

std::uint32_t CsgFold::partBehindCap(std::uint32_t output, std::uint32_t section) const {
  std::uint32_t part = section;
  for (std::uint32_t i = 0; i < leaves_.size(); ++i) {
    const bool later = leaves_[i] < forest_.firstSection && (part == section || leaves_[i] > part);
    if (later && fills(i, output)) part = leaves_[i];
  }
  return part;
}

// True when the inside of the leaf is here inside the output, and all on the way between them.
bool CsgFold::fills(std::uint32_t leaf, std::uint32_t output) const {
  if (!inside(states_[leaf].winding)) return false;
  for (const PrunedForest::Use& use : pruned_.uses(leaf)) {
    bool value = !use.negated;
    for (std::uint32_t g = use.node; g != kNone && value && gates_[g].isTrue(); g = gates_[g].parent) {
      if (gates_[g].output == output) return true;
      value = !gates_[g].negated;
    }
  }
  return false;
}

// The slot of the group whose face shows for a result that the group made true.
std::uint32_t CsgFold::showingFace(std::uint32_t output) {
  const std::span<const std::uint32_t> group(group_.data(), groupCount_);
  for (std::uint32_t slot : group) change_[slots_[slot].object] += slots_[slot].side;
  std::uint32_t best = group.back(), bestLeaf = 0;
  bool found = false, bestFaces = false;
  // The last leaf that brings the change about is met first; the way up may be long.
  for (std::uint32_t slot : group) {
    const std::uint32_t leaf = slots_[slot].object;
    if (found && leaf != bestLeaf) break;
    const bool faces = (slots_[slot].side > 0) == (change_[leaf] > 0);   // turned the way the leaf changes
    if (found ? !faces || bestFaces : !bringsChange(leaf, output)) continue;
    found = true, best = slot, bestLeaf = leaf, bestFaces = faces;
  }
  for (std::uint32_t slot : group) change_[slots_[slot].object] = 0;
  return best;
}

// True when the leaf's change in the group travels up to the output: every gate on the way changes with its input.
bool CsgFold::bringsChange(std::uint32_t leaf, std::uint32_t output) const {
  const bool after = inside(states_[leaf].winding), before = inside(states_[leaf].winding - change_[leaf]);
  if (before == after) return false;
  for (const PrunedForest::Use& use : pruned_.uses(leaf)) {
    bool value = after != use.negated;
    for (std::uint32_t g = use.node; g != kNone; g = gates_[g].parent) {
      const bool was = before_[g].isTrue(), is = gates_[g].isTrue();
      if (was == is || is != value) break;
      if (gates_[g].output == output) return true;
      value = is != gates_[g].negated;
    }
  }
  return false;
}

}  // namespace copeel::csg
