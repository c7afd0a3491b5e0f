// Bottom up over the post-order nodes.
#include "apps/csg/bounds.h"

#include <unordered_map>

#include "core/scene/scene.h"

namespace copeel::csg {
namespace {

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

}  // namespace

Box viewBounds(const Model& model) {
  std::unordered_map<const Mesh*, Box> meshBoxes;
  std::vector<Box> boxes(model.nodes.size());
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const Node& node = model.nodes[n];
    if (node.operation == Operation::Leaf) {
      const Leaf& leaf = model.leaves[node.leaf];
      auto [entry, fresh] = meshBoxes.try_emplace(leaf.mesh.get());
      if (fresh) entry->second = boundingBox(*leaf.mesh);
      boxes[n] = placed(entry->second, leaf.worldFromObject);
      continue;
    }
    for (std::uint32_t i = 0; i < node.childCount; ++i) {
      const Box& child = boxes[model.childIndices[node.firstChild + i]];
      if (i == 0) boxes[n] = child;
      else if (node.operation == Operation::Union) boxes[n].add(child);
      else if (node.operation == Operation::Intersection) boxes[n] = common(boxes[n], child);
    }
  }
  Box result = model.root == kNoNode ? Box{} : boxes[model.root];
  for (std::uint32_t root : model.background) result.add(boxes[root]);
  for (std::uint32_t root : model.highlight) result.add(boxes[root]);
  return result;
}

}  // namespace copeel::csg
