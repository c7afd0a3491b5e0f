// Leaf nodes to meshes; nodes of the same shape get one mesh.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "apps/csg/csg_syntax.h"
#include "apps/csg/external.h"
#include "apps/csg/solids.h"

namespace copeel::csg {

class Shapes {
 public:
  // `folder` is where relative paths start. `external` holds what openscad evaluated for this tree.
  Shapes(const SyntaxTree& tree, std::string folder, const ExternalShapes& external)
      : tree_(tree), folder_(std::move(folder)), external_(external) {}

  // The mesh of a leaf node, null where it is empty. A flat shape is a slab of thickness 1, as openscad previews it.
  MeshPointer meshOf(std::uint32_t node);
  std::vector<std::string>& warnings() { return warnings_; }

 private:
  MeshPointer make(std::uint32_t node);
  MeshPointer makeCylinderOf(const SyntaxNode& node) const;
  MeshPointer makePolyhedronOf(const SyntaxNode& node) const;
  MeshPointer makeExternal(std::uint32_t node);
  MeshPointer makeImport(const SyntaxNode& node);
  MeshPointer makeLinearExtrude(std::uint32_t node);
  MeshPointer makeRotateExtrude(std::uint32_t node);
  std::string keyOf(const SyntaxNode& node) const;

  const SyntaxTree& tree_;
  std::string folder_;
  const ExternalShapes& external_;
  std::vector<std::string> warnings_;
  std::unordered_map<std::string, MeshPointer> meshes_;
};

// What a node makes by itself, whatever its children are.
bool isTreeKeyword(Keyword keyword);       // group … render: its children are placed one by one

// One shape, but openscad shows what carries % or # within: hull, minkowski and resize, not extrusions, offset or projection.
bool showsMarksWithin(Keyword keyword);

// What carries % or # within a shape is a shape of its own, and may hold more of them. Each costs as much as all below it, so that there is an
// end to it.
inline constexpr std::size_t kMostShapesWithinShapes = 64;

// Only openscad itself evaluates this node with all below it.
bool isExternalNode(const SyntaxTree& tree, std::uint32_t node);

// 2 or 3 for each node, 0 for nothing: the dimension of the first child that has one.
std::vector<std::uint8_t> dimensionsOf(const SyntaxTree& tree);

}  // namespace copeel::csg
