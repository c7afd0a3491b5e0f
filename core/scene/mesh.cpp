// The bounds of a mesh: of what can be seen, so a vertex that no triangle uses does not move the camera.
#include "core/scene/mesh.h"

namespace copeel {

std::vector<std::uint8_t> usedVertices(const Mesh& mesh) {
  std::vector<std::uint8_t> used(mesh.vertices.size());
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = 1;
  return used;
}

Box boundingBox(const Mesh& mesh) {
  Box box;
  const std::vector<std::uint8_t> used = usedVertices(mesh);
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v]) box.add(mesh.vertices[v]);
  }
  return box;
}

}  // namespace copeel
