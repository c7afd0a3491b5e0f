// Faces of any number of corners to triangles. A face is seen along the axis its mean normal is nearest to and triangulated there, as
// openscad does; the halves of a bent face are facets of their own.
#include <algorithm>
#include <cmath>
#include <span>

#include "apps/csg/mesh_builder.h"
#include "apps/csg/orientation.h"
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

// Drops the coordinate along which the face is seen largest. Axes and signs are those of libtess2, which openscad uses: they decide ties.
std::vector<glm::dvec2> projected(const std::vector<glm::dvec3>& corners, const glm::dvec3& normal) {
  const glm::dvec3 size = glm::abs(normal);
  int axis = size.y > size.x ? 1 : 0;
  if (size.z > size[axis]) axis = 2;
  const double sign = normal[axis] > 0 ? 1 : -1;
  std::vector<glm::dvec2> flat;
  for (const glm::dvec3& p : corners) flat.emplace_back(p[(axis + 1) % 3], sign * p[(axis + 2) % 3]);
  return flat;
}

// The diagonal of a convex quad: true for 0-2. Delaunay's; where all four corners lie on one circle, what libtess2's sweep leaves: the
// diagonal from the rightmost corner, unless the leftmost one is opposite.
bool takesFirstDiagonal(const std::vector<glm::dvec2>& quad) {
  const double circle = inCircle(quad[0], quad[1], quad[2], quad[3]);
  if (circle != 0) return circle < 0;
  const auto less = [](const glm::dvec2& p, const glm::dvec2& q) { return p.x != q.x ? p.x < q.x : p.y < q.y; };
  const auto right = std::max_element(quad.begin(), quad.end(), less) - quad.begin();
  const auto left = std::min_element(quad.begin(), quad.end(), less) - quad.begin();
  const bool evenDiagonal = right % 2 == 0;
  return (right + 2) % 4 == left ? !evenDiagonal : evenDiagonal;
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
    const bool convex = isConvexLoop(flat);
    if (!bent && convex) return builder_.addConvexFacet(face);
    if (bent && convex && face.size() == 4) return addBentQuad(face, takesFirstDiagonal(flat) ? 0 : 1);
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
  void addBentQuad(std::span<const std::uint32_t> face, std::size_t first) {
    builder_.addTriangleFacet(face[first], face[first + 1], face[first + 2]);
    builder_.addTriangleFacet(face[first], face[first + 2], face[(first + 3) % 4]);
  }

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
  builder.reserve(points.size(), indices.size() - std::min(indices.size(), 2 * faceEnds.size()));
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
