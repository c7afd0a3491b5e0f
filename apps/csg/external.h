// Subtrees that only openscad itself evaluates (text, offset, hull, minkowski, projection, surface, resize, import of what is no mesh):
// found first, run together, kept in a cache of files named by their content.
#pragma once

#include <string>
#include <unordered_map>
#include <vector>

#include "apps/csg/csg_syntax.h"
#include "apps/csg/read_model.h"
#include "apps/csg/solids.h"

namespace copeel::csg {

struct ExternalShape {
  bool flat = false;                // the mesh is the flat shape drawn up by 1
  MeshPointer mesh;                 // null: nothing
};

struct ExternalShapes {
  std::unordered_map<std::uint32_t, ExternalShape> shapes;   // by index of the subtree's node
  std::vector<std::string> warnings;
};

// Throws Error{Machine} where openscad cannot be run and something needs it.
ExternalShapes evaluateExternal(const SyntaxTree& tree, const std::string& folder, const ReadOptions& options);

}  // namespace copeel::csg
