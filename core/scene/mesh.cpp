// The bounds of a mesh: of what can be seen, so a vertex that no triangle uses does not move the camera.
#include "core/scene/mesh.h"

namespace copeel {

Box boundingBox(const Mesh& mesh) {
  Box box;
  for (const glm::uvec3& triangle : mesh.triangles) {
    for (int corner = 0; corner < 3; ++corner) box.add(mesh.vertices[triangle[corner]]);
  }
  return box;
}

}  // namespace copeel
