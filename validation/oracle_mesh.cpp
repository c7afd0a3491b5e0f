#include "validation/oracle_mesh.h"

#include <map>
#include <utility>

#include <glm/matrix.hpp>

#include "core/scene/scene.h"

namespace copeel::validation {

ExactPoint OracleMesh::exactVertex(std::uint32_t index) const {
  if (!exactVertices.empty()) return exactVertices[index];
  const glm::dvec3& p = vertices[index];
  return {mpq_class(p.x), mpq_class(p.y), mpq_class(p.z)};
}

Box boundsOf(const OracleMesh& mesh) {
  Box box;
  for (const glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) box.add(mesh.vertices[t[i]]);
  return box;
}

bool isClosed(const OracleMesh& mesh) {
  // Vertices at one position get one number, so that soups without shared vertices can be closed.
  std::map<std::array<double, 3>, std::uint32_t> roundedNumber;
  std::map<ExactPoint, std::uint32_t> exactNumber;
  std::vector<std::uint32_t> number(mesh.vertices.size());
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    const glm::dvec3& p = mesh.vertices[i];
    number[i] = mesh.exactVertices.empty()
                    ? roundedNumber.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, roundedNumber.size()).first->second
                    : exactNumber.try_emplace(mesh.exactVertices[i], exactNumber.size()).first->second;
  }

  // The balance of an undirected edge counts one direction up and the other down.
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> balance;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t p = number[t[i]], q = number[t[(i + 1) % 3]];
      if (p != q) balance[{std::min(p, q), std::max(p, q)}] += p < q ? 1 : -1;
    }
  }
  for (const auto& [edge, sum] : balance)
    if (sum != 0) return false;
  return true;
}

OracleMesh leafMesh(const csg::Model& model, std::uint32_t index) {
  const csg::Leaf& leaf = model.leaves[index];
  OracleMesh out;
  out.vertices.reserve(leaf.mesh->vertices.size());
  for (const glm::dvec3& p : leaf.mesh->vertices) out.vertices.push_back(transformPoint(leaf.worldFromObject, p));
  out.triangles = leaf.mesh->triangles;
  if (glm::determinant(glm::dmat3(leaf.worldFromObject)) < 0)
    for (glm::uvec3& t : out.triangles) std::swap(t.y, t.z);
  return out;
}

OracleMesh transformedExactly(const OracleMesh& mesh, const glm::dmat4& matrix) {
  OracleMesh out;
  out.triangles = mesh.triangles;
  for (std::uint32_t i = 0; i < mesh.vertices.size(); ++i) {
    const ExactPoint p = mesh.exactVertex(i);
    ExactPoint q;
    for (int row = 0; row < 3; ++row) {
      q[row] = mpq_class(matrix[3][row]);
      for (int column = 0; column < 3; ++column) q[row] += mpq_class(matrix[column][row]) * p[column];
    }
    out.vertices.push_back({q[0].get_d(), q[1].get_d(), q[2].get_d()});
    out.exactVertices.push_back(std::move(q));
  }
  if (glm::determinant(glm::dmat3(matrix)) < 0)
    for (glm::uvec3& t : out.triangles) std::swap(t.y, t.z);
  return out;
}

}  // namespace copeel::validation
