// The fold's tile and pixel state; see csg_fold.h for the rules.
#include "apps/csg/csg_fold.h"

#include <algorithm>

namespace copeel::csg {

bool CsgFold::beginTile(cpu::Tile& tile) {
  // The tile's leaves are its objects and the open leaves that hold the eye without showing a triangle here.
  leaves_.clear();
  for (const cpu::TileObject& object : tile.objects) leaves_.push_back(object.object);
  if (eye_.any) {
    for (std::uint32_t leaf = 0; leaf < eye_.constant.size(); ++leaf) {
      if (eye_.constant[leaf] != 0) leaves_.push_back(leaf);
    }
    std::sort(leaves_.begin(), leaves_.end());
    leaves_.erase(std::unique(leaves_.begin(), leaves_.end()), leaves_.end());
  }
  if (leaves_.empty()) return false;
  pruned_.prune(forest_, leaves_);
  nodes_ = pruned_.nodes();
  if (nodes_.empty()) return false;

  localOfObject_.resize(tile.objects.size());
  tileNeedsStack_ = false;
  for (std::uint32_t i = 0, local = 0; i < tile.objects.size(); ++i) {
    while (leaves_[local] != tile.objects[i].object) ++local;
    localOfObject_[i] = local;
    tile.objects[i].keep = pruned_.matters(local);
    if (eye_.any && tile.objects[i].keep && eye_.fromStack[leaves_[local]]) tileNeedsStack_ = true;
  }

  // The state in which every pixel starts.
  winding_.assign(leaves_.size(), 0);
  counts_.resize(nodes_.size());
  for (std::size_t n = 0; n < nodes_.size(); ++n) counts_[n] = nodes_[n].initial;
  topOfOutput_.assign(forest_.outputs.size(), kNone);
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    if (nodes_[n].output != kNone) topOfOutput_[nodes_[n].output] = n;
  }
  change_.assign(leaves_.size(), 0);
  if (eye_.any) {
    for (std::uint32_t local = 0; local < leaves_.size(); ++local) {
      if (eye_.constant[leaves_[local]] != 0) addWinding(local, eye_.constant[leaves_[local]]);
    }
    risen_.clear();
  }
  initialCounts_ = counts_;
  initialWinding_ = winding_;
  return true;
}

void CsgFold::beginPixel(const PixelStack& stack) {
  slots_ = stack.slots;
  winding_.assign(initialWinding_.begin(), initialWinding_.end());
  counts_.assign(initialCounts_.begin(), initialCounts_.end());
  group_.clear();
  surfaces_.clear();
  enough_ = false;
  if (!tileNeedsStack_) return;
  // A closed leaf around the start of the ray: its crossings sum to minus the winding number there.
  for (std::uint32_t i = 0; i < stack.count; ++i) {
    const cpu::TileSlot& slot = slots_[stack.slot(i)];
    const std::uint32_t local = localOfObject_[slot.object];
    if (eye_.fromStack[leaves_[local]]) addWinding(local, -slot.side);
  }
  risen_.clear();
}

void CsgFold::addWinding(std::uint32_t local, std::int32_t change) {
  const bool before = inside(winding_[local]);
  winding_[local] += change;
  const bool after = inside(winding_[local]);
  if (before != after) toggle(local, after);
}

void CsgFold::toggle(std::uint32_t local, bool nowInside) {
  for (const PrunedForest::Use& use : pruned_.uses(local)) {
    bool value = nowInside != use.negated;
    for (std::uint32_t n = use.node; n != kNone;) {
      const bool was = nodeTrue(n);
      counts_[n] += value ? 1 : -1;
      const bool is = nodeTrue(n);
      if (was == is) break;
      if (nodes_[n].output != kNone && is) risen_.push_back(nodes_[n].output);
      value = is != nodes_[n].negated;
      n = nodes_[n].parent;
    }
  }
}

bool CsgFold::closeGroup() {
  risen_.clear();
  if (group_.size() > 1) before_ = counts_;
  for (std::uint32_t slot : group_) addWinding(localOfObject_[slots_[slot].object], slots_[slot].side);
  if (!risen_.empty()) {
    std::sort(risen_.begin(), risen_.end());
    risen_.erase(std::unique(risen_.begin(), risen_.end()), risen_.end());
    for (std::uint32_t output : risen_) {
      // Only a result that was false before the whole group and is true after it shows a surface.
      const std::uint32_t top = topOfOutput_[output];
      const bool was = group_.size() > 1 && before_[top] >= nodes_[top].threshold;
      if (!was && nodeTrue(top) && !enough_) showSurface(output);
    }
  }
  group_.clear();
  return enough_;
}

void CsgFold::showSurface(std::uint32_t output) {
  const cpu::TileSlot& face = slots_[group_.size() == 1 ? group_[0] : showingFace(output)];
  const std::uint32_t leaf = leaves_[localOfObject_[face.object]];
  const Output& result = forest_.outputs[output];
  const double alpha = alpha_(context_, leaf, result.part);
  // A translucent face of the opaque share has been blended as a face of the whole.
  if (alpha <= 0 || (alpha < 1 && result.opaqueShare)) return;
  surfaces_.push_back({face.primitive, face.planeClass, leaf, result.part});
  enough_ = alpha >= 1;
}

// The slot of the group whose face shows for a result that the group made true.
std::uint32_t CsgFold::showingFace(std::uint32_t output) {
  for (std::uint32_t slot : group_) change_[localOfObject_[slots_[slot].object]] += slots_[slot].side;
  std::uint32_t best = group_.front(), bestLeaf = 0;
  bool found = false, bestFaces = false;
  for (std::uint32_t slot : group_) {
    const std::uint32_t local = localOfObject_[slots_[slot].object];
    if (found && local < bestLeaf) continue;
    const bool faces = (slots_[slot].side > 0) == (change_[local] > 0);   // turned the way the leaf changes
    const bool better = !found || local > bestLeaf || faces > bestFaces || (faces == bestFaces && slot > best);
    if (!better || !bringsChange(local, output)) continue;
    found = true, best = slot, bestLeaf = local, bestFaces = faces;
  }
  for (std::uint32_t slot : group_) change_[localOfObject_[slots_[slot].object]] = 0;
  return best;
}

// True when the leaf's change in the group travels up to the output: every gate on the way changes with its input.
bool CsgFold::bringsChange(std::uint32_t local, std::uint32_t output) const {
  const bool after = inside(winding_[local]), before = inside(winding_[local] - change_[local]);
  if (before == after) return false;
  for (const PrunedForest::Use& use : pruned_.uses(local)) {
    bool value = after != use.negated;
    for (std::uint32_t n = use.node; n != kNone; n = nodes_[n].parent) {
      const bool was = before_[n] >= nodes_[n].threshold, is = nodeTrue(n);
      if (was == is || is != value) break;
      if (nodes_[n].output == output) return true;
      value = is != nodes_[n].negated;
    }
  }
  return false;
}

}  // namespace copeel::csg
