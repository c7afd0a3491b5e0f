// CSG trees written as expressions; leaves are numbered in the order of the tree, as a parser would.
#pragma once

#include <optional>
#include <vector>

#include "apps/csg/csg_model.h"
#include "tests/support/meshes.h"

namespace copeel::test {

struct Tree {
  csg::Operation operation = csg::Operation::Union;
  csg::Leaf leaf;                 // Operation::Leaf only
  std::vector<Tree> children;
};

inline Tree leaf(MeshPointer mesh, std::optional<glm::dvec4> color = {}, const glm::dmat4& m = glm::dmat4(1)) {
  return {csg::Operation::Leaf, {std::move(mesh), m, color}, {}};
}
inline Tree leaf(Mesh mesh, std::optional<glm::dvec4> color = {}, const glm::dmat4& m = glm::dmat4(1)) {
  return leaf(share(std::move(mesh)), color, m);
}
inline Tree unite(std::vector<Tree> children) { return {csg::Operation::Union, {}, std::move(children)}; }
inline Tree intersect(std::vector<Tree> children) { return {csg::Operation::Intersection, {}, std::move(children)}; }
inline Tree subtract(std::vector<Tree> children) { return {csg::Operation::Difference, {}, std::move(children)}; }

inline std::uint32_t addTree(csg::Model& model, const Tree& tree) {
  csg::Node node;
  node.operation = tree.operation;
  std::vector<std::uint32_t> children;
  for (const Tree& child : tree.children) children.push_back(addTree(model, child));
  if (tree.operation == csg::Operation::Leaf) {
    node.leaf = static_cast<std::uint32_t>(model.leaves.size());
    model.leaves.push_back(tree.leaf);
  }
  node.firstChild = static_cast<std::uint32_t>(model.childIndices.size());
  node.childCount = static_cast<std::uint32_t>(children.size());
  model.childIndices.insert(model.childIndices.end(), children.begin(), children.end());
  model.nodes.push_back(node);
  return static_cast<std::uint32_t>(model.nodes.size() - 1);
}

inline csg::Model modelOf(const Tree& tree) {
  csg::Model model;
  model.root = addTree(model, tree);
  return model;
}

// Every leaf moved by `m`.
inline csg::Model placed(csg::Model model, const glm::dmat4& m) {
  for (csg::Leaf& leaf : model.leaves) leaf.worldFromObject = m * leaf.worldFromObject;
  return model;
}

}  // namespace copeel::test
