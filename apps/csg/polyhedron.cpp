// Faces of any number of corners to triangles. A face is seen along the axis its mean normal is nearest to and triangulated there, as
// openscad does; the halves of a bent face are facets of their own.
#include <algorithm>
#include <cmath>
#include <span>

#include "apps/csg/mesh_builder.h"
#include "apps/csg/solids.h"
#include "apps/csg/triangulate.h"

namespace copeel::csg {
namespace {

// Corners this far from their plane, relative to the coordinates, are rounding of the numbers as written (six digits and more).
constexpr double kBent = 1e-6;

// The area vector, doubled: exact for a plane, a mean for a bent face.
glm::dvec3 meanNormal(const std::vector<glm::dvec3>& corners) {
  glm::dvec3 normal(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = corners[i] - corners[0], b = corners[(i + 1) % corners.size()] - corners[0];
    normal += glm::cross(a, b);
  }
  return normal;
}

// Drops the coordinate along which the face is seen largest; a left turn stays one where the normal looks at us.
std::vector<glm::dvec2> projected(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  int u = 0, v = 1;
  double direction = normal.z;
  if (size.x > size.y && size.x > size.z) u = 1, v = 2, direction = normal.x;
  else if (size.y > size.z) u = 2, v = 0, direction = normal.y;
  std::vector<glm::dvec2> flat;
  for (const glm::dvec3& p : corners) flat.push_back(direction < 0 ? glm::dvec2(p[v], p[u]) : glm::dvec2(p[u], p[v]));
  return flat;
}

bool isBent(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
  const double length = std::sqrt(glm::dot(normal, normal));
  double extent = 0, distance = 0;
  for (const glm::dvec3& p : corners) {
    distance = std::max(distance, std::abs(glm::dot(p - corners[0], normal)) / length);
    extent = std::max({extent, std::abs(p.x), std::abs(p.y), std::abs(p.z)});
  }
  return !(distance <= kBent * extent);
}

class FaceBuilder {
 public:
  explicit FaceBuilder(MeshBuilder& builder) : builder_(builder) {}

  void add(std::span<const std::uint32_t> face) {
    corners_.clear();
    for (const std::uint32_t index : face) corners_.push_back(builder_.vertex(index));
    const glm::dvec3 normal = meanNormal(corners_);
    const std::vector<glm::dvec2> flat = projected(corners_, normal);
    const bool bent = isBent(corners_, normal);
    if (!bent && isConvexLoop(flat)) return builder_.addConvexFacet(face);
    const std::uint32_t end[] = {static_cast<std::uint32_t>(face.size())};
    std::optional<std::vector<glm::uvec3>> triangles = triangulate(flat, end);
    builder_.beginFacet();
    if (!triangles || triangles->size() != face.size() - 2) triangles = fan(face.size());
    for (const glm::uvec3& t : *triangles) {
      if (bent) builder_.beginFacet();
      builder_.addTriangle(face[t.x], face[t.y], face[t.z]);
    }
  }

 private:
  // For faces that cross themselves: signed, it covers what winding numbers count.
  static std::vector<glm::uvec3> fan(std::size_t count) {
    std::vector<glm::uvec3> triangles;
    for (std::uint32_t i = 1; i + 1 < count; ++i) triangles.emplace_back(0u, i, i + 1);
    return triangles;
  }

  MeshBuilder& builder_;
  std::vector<glm::dvec3> corners_;
};

}  // namespace

MeshPointer makePolyhedron(const std::vector<glm::dvec3>& points, const std::vector<std::uint32_t>& indices,
                           const std::vector<std::uint32_t>& faceEnds) {
  MeshBuilder builder;
  for (const glm::dvec3& point : points) builder.addVertex(point);
  FaceBuilder faces(builder);
  std::size_t begin = 0;
  std::vector<std::uint32_t> face;
  for (const std::uint32_t end : faceEnds) {
    // openscad's faces run clockwise seen from outside, ours the other way.
    face.assign(indices.begin() + static_cast<std::ptrdiff_t>(begin), indices.begin() + end);
    std::reverse(face.begin(), face.end());
    begin = end;
    if (face.size() == 3) builder.addTriangleFacet(face[0], face[1], face[2]);
    if (face.size() > 3) faces.add(face);
  }
  return faceEnds.empty() ? nullptr : builder.finish();
}

}  // namespace copeel::csg
