// Boxes bottom up over the post-order nodes, then top down where a leaf can be seen.
//
// A − (B − C) is (A − B) ∪ (A ∩ C): C is intersected, though it stands within what is subtracted. So each node has two regions, the one in which
// it is added and the one in which it is subtracted; both are boxes, the common part of what stands beside it on the way down.
#include "apps/csg/bounds.h"

#include <limits>
#include <unordered_map>

#include "core/scene/scene.h"

namespace copeel::csg {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

Box placed(const Box& box, const glm::dmat4& m) {
  Box result;
  if (box.empty()) return result;
  for (int corner = 0; corner < 8; ++corner) {
    result.add(transformPoint(m, {corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y, corner & 4 ? box.max.z : box.min.z}));
  }
  return result;
}

Box common(const Box& a, const Box& b) {
  Box result;
  result.min = glm::max(a.min, b.min);
  result.max = glm::min(a.max, b.max);
  return result.empty() ? Box{} : result;
}

struct Regions {
  Box added, subtracted;   // empty: not reached
};

class Bounds {
 public:
  explicit Bounds(const Model& model) : model_(model), boxes_(model.nodes.size()) { measure(); }

  // Of all leaves that are seen of these trees.
  Box seen(const std::vector<std::uint32_t>& roots) const {
    std::vector<Regions> regions(boxes_.size());
    for (const std::uint32_t root : roots) regions[root].added = {glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
    Box result;
    for (std::size_t n = boxes_.size(); n-- > 0;) {
      if (model_.nodes[n].operation != Operation::Leaf) passDown(n, regions);
      else if (!common(regions[n].added, boxes_[n]).empty()) result.add(boxes_[n]);
    }
    return result;
  }

 private:
  std::uint32_t childOf(const Node& node, std::uint32_t i) const { return model_.childIndices[node.firstChild + i]; }

  void measure() {
    std::unordered_map<const Mesh*, Box> meshBoxes;
    for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
      const Node& node = model_.nodes[n];
      if (node.operation == Operation::Leaf) {
        const Leaf& leaf = model_.leaves[node.leaf];
        const auto [entry, fresh] = meshBoxes.try_emplace(leaf.mesh.get());
        if (fresh) entry->second = boundingBox(*leaf.mesh);
        Box box = entry->second;
        if (leaf.isFlat) box.min.z = box.max.z = 0;
        boxes_[n] = placed(box, leaf.worldFromObject);
      }
      for (std::uint32_t i = 0; i < node.childCount; ++i) {
        const Box& child = boxes_[childOf(node, i)];
        if (i == 0) boxes_[n] = child;
        else if (node.operation == Operation::Union) boxes_[n].add(child);
        else if (node.operation == Operation::Intersection) boxes_[n] = common(boxes_[n], child);
      }
    }
  }

  void passDown(std::size_t n, std::vector<Regions>& regions) const {
    const Node& node = model_.nodes[n];
    const Regions own = regions[n];
    if (own.added.empty() && own.subtracted.empty()) return;
    if (node.operation == Operation::Intersection) return passDownIntersection(node, own, regions);
    const bool isDifference = node.operation == Operation::Difference;
    for (std::uint32_t i = 0; i < node.childCount; ++i) {
      Regions& child = regions[childOf(node, i)];
      const bool isCutter = isDifference && i > 0;
      (isCutter ? child.subtracted : child.added).add(isCutter ? common(own.added, boxes_[childOf(node, 0)]) : own.added);
      (isCutter ? child.added : child.subtracted).add(own.subtracted);
    }
  }

  // Each operand is limited by all others: those before it, from the left, and those after it, from the right.
  void passDownIntersection(const Node& node, const Regions& own, std::vector<Regions>& regions) const {
    std::vector<Box> after(node.childCount + 1);
    after[node.childCount] = own.added;
    for (std::uint32_t i = node.childCount; i-- > 0;) after[i] = common(after[i + 1], boxes_[childOf(node, i)]);
    Box before{glm::dvec3(-kInfinity), glm::dvec3(kInfinity)};
    for (std::uint32_t i = 0; i < node.childCount; ++i) {
      Regions& child = regions[childOf(node, i)];
      child.added.add(common(before, after[i + 1]));
      child.subtracted.add(own.subtracted);
      before = common(before, boxes_[childOf(node, i)]);
    }
  }

  const Model& model_;
  std::vector<Box> boxes_;   // of each node: what it can fill at most
};

}  // namespace

Box viewBounds(const Model& model) {
  std::vector<std::uint32_t> roots = model.background;
  roots.insert(roots.end(), model.highlight.begin(), model.highlight.end());
  if (model.root != kNoNode) roots.push_back(model.root);
  return Bounds(model).seen(roots);
}

}  // namespace copeel::csg
