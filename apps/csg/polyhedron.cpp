// Faces of any number of corners to triangles.
#include <algorithm>

#include "apps/csg/mesh_builder.h"
#include "apps/csg/solids.h"

namespace copeel::csg {

MeshPointer makePolyhedron(const std::vector<glm::dvec3>& points, const std::vector<std::uint32_t>& indices,
                           const std::vector<std::uint32_t>& faceEnds) {
  MeshBuilder builder;
  for (const glm::dvec3& point : points) builder.addVertex(point);
  std::size_t begin = 0;
  for (const std::uint32_t end : faceEnds) {
    std::vector<std::uint32_t> corners(indices.begin() + static_cast<std::ptrdiff_t>(begin), indices.begin() + end);
    std::reverse(corners.begin(), corners.end());
    begin = end;
    if (corners.size() >= 3) builder.addConvexFacet(corners);
  }
  return builder.finish();
}

}  // namespace copeel::csg
