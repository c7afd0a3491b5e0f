// The notable things of small meshes, counted by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "mesh_texts.h"

namespace copeel {
namespace {

Mesh tetrahedron() {
  Mesh mesh;
  mesh.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  return mesh;
}

void append(Mesh& mesh, Mesh other) {  // by value: a mesh may be appended to itself
  const auto shift = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const glm::uvec3& t : other.triangles) mesh.triangles.push_back(t + shift);
}

TEST(MeshStatus, aClosedSolidHasNothingToSay) {
  const MeshStatus status = statusOf(tetrahedron());
  EXPECT_TRUE(status.closed);
  EXPECT_FALSE(status.insideOut);
  EXPECT_EQ(status.triangleCount, 4u);
  EXPECT_EQ(status.summary(), "");
}

TEST(MeshStatus, aSoupIsClosedByPositionAndMinusZeroIsZero) {
  Mesh soup;
  for (const glm::uvec3& t : tetrahedron().triangles) {
    for (int i = 0; i < 3; ++i) soup.vertices.push_back(tetrahedron().vertices[t[i]]);
    const auto n = static_cast<std::uint32_t>(soup.vertices.size());
    soup.triangles.emplace_back(n - 3, n - 2, n - 1);
  }
  soup.vertices[0] = {-0.0, 0.0, -0.0};
  EXPECT_EQ(statusOf(soup).summary(), "");
}

TEST(MeshStatus, insideOutHasNegativeVolumeAtAnyScaleAndPlace) {
  for (const double scale : {1e-300, 1e-9, 1.0, 1e9, 1e300}) {
    Mesh mesh = tetrahedron();
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    for (glm::dvec3& v : mesh.vertices) v = (v + glm::dvec3(5, 6, 7)) * scale;
    EXPECT_EQ(statusOf(mesh).summary(), "inside out") << scale;
  }
}

TEST(MeshStatus, aHoleHasBoundaryEdges) {
  Mesh mesh = tetrahedron();
  mesh.triangles.pop_back();
  const MeshStatus status = statusOf(mesh);
  EXPECT_FALSE(status.closed);
  EXPECT_EQ(status.boundaryEdgeCount, 3u);
  EXPECT_EQ(status.summary(), "not closed (3 boundary edges)");
}

TEST(MeshStatus, nonManifoldButBalancedIsClosed) {
  // Two tetrahedra that share an edge: four faces meet there, two in each direction.
  Mesh mesh = tetrahedron(), other = tetrahedron();
  for (glm::dvec3& v : other.vertices) v = {-v.x, -v.y, v.z};
  append(mesh, other);
  const MeshStatus status = statusOf(mesh);
  EXPECT_TRUE(status.closed);
  EXPECT_EQ(status.nonManifoldEdgeCount, 1u);
  EXPECT_EQ(status.summary(), "1 non-manifold edge");
}

TEST(MeshStatus, inconsistentOrientation) {
  Mesh mesh = tetrahedron();
  std::swap(mesh.triangles[0].x, mesh.triangles[0].y);
  const MeshStatus status = statusOf(mesh);
  EXPECT_EQ(status.inconsistentEdgeCount, 3u);
  EXPECT_EQ(status.summary(), "not closed, 3 inconsistently oriented edges");
}

TEST(MeshStatus, duplicatesOfEitherOrientation) {
  Mesh mesh = tetrahedron();
  append(mesh, mesh);
  EXPECT_EQ(statusOf(mesh).duplicateTriangleCount, 4u);
  std::swap(mesh.triangles[6].x, mesh.triangles[6].y);
  mesh.triangles[5] = {mesh.triangles[5].y, mesh.triangles[5].z, mesh.triangles[5].x};
  EXPECT_EQ(statusOf(mesh).duplicateTriangleCount, 4u);
}

TEST(MeshStatus, zeroAreaIsFoundExactly) {
  // As doubles, (0.1, 0.2, 0.3) and (0.3, 0.6, 0.9) are not on one line with the origin; quarters are. An area of 1e-600 is not none.
  Mesh mesh;
  mesh.vertices = {{0, 0, 0},       {0.25, 0.5, 0.75}, {0.5, 1, 1.5}, {0.1, 0.2, 0.3},
                   {0.3, 0.6, 0.9}, {1e-300, 0, 0},    {0, 1e-300, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 1, 1}, {5, 6, 0}, {0, 3, 4}};
  const MeshStatus status = statusOf(mesh);
  EXPECT_EQ(status.degenerateTriangleCount, 2u);
}

TEST(MeshStatus, trianglesWithTwoEqualCornersHaveNoSayInEdges) {
  Mesh mesh = tetrahedron();
  mesh.triangles.emplace_back(0, 1, 1);
  const MeshStatus status = statusOf(mesh);
  EXPECT_TRUE(status.closed);
  EXPECT_EQ(status.nonManifoldEdgeCount, 0u);
  EXPECT_EQ(status.summary(), "1 degenerate triangle");
}

TEST(MeshStatus, unreferencedVerticesAndNoTriangles) {
  Mesh mesh = tetrahedron();
  mesh.vertices.emplace_back(9, 9, 9);
  EXPECT_EQ(statusOf(mesh).summary(), "1 unreferenced vertex");
  EXPECT_EQ(boundingBox(mesh).max, glm::dvec3(1, 1, 1));
  EXPECT_EQ(statusOf(Mesh{}).summary(), "no triangles");
  EXPECT_TRUE(statusOf(Mesh{}).closed);
}

}  // namespace
}  // namespace copeel
