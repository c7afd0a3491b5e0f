// Files written by OpenMesh, whose writers know nothing of our readers, in every form it has: what it meant is what we read.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include <OpenMesh/Core/IO/MeshIO.hh>
#include <OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh>

#include "core/formats/read_mesh.h"
#include "tests/temporary_folder.h"

namespace copeel {
namespace {

using PolyMesh = OpenMesh::PolyMesh_ArrayKernelT<>;
using Corners = std::array<std::array<double, 3>, 3>;

// A triangulated cube with a face left open; coordinates that floats and six decimal digits hold exactly.
PolyMesh openCube() {
  PolyMesh mesh;
  std::vector<PolyMesh::VertexHandle> v;
  for (int i = 0; i < 8; ++i)
    v.push_back(mesh.add_vertex({i & 1 ? 1.5f : -0.25f, i & 2 ? 2.f : 0.f, i & 4 ? 1.f : -0.125f}));
  const int quads[5][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}};
  for (const auto& q : quads) {
    mesh.add_face(v[q[0]], v[q[1]], v[q[2]]);
    mesh.add_face(v[q[0]], v[q[2]], v[q[3]]);
  }
  return mesh;
}

// Each triangle from its smallest corner on, all of them sorted.
std::vector<Corners> canonical(std::vector<Corners> triangles) {
  for (Corners& t : triangles) std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
  std::sort(triangles.begin(), triangles.end());
  return triangles;
}

std::vector<Corners> cornersOf(const PolyMesh& mesh) {
  std::vector<Corners> triangles;
  for (const auto face : mesh.faces()) {
    Corners corners;
    int k = 0;
    for (const auto vertex : mesh.fv_range(face)) {
      const auto& p = mesh.point(vertex);
      corners[k++] = {p[0], p[1], p[2]};
    }
    triangles.push_back(corners);
  }
  return canonical(triangles);
}

std::vector<Corners> cornersOf(const Mesh& mesh) {
  std::vector<Corners> triangles;
  for (const glm::uvec3& t : mesh.triangles) {
    Corners corners;
    for (int k = 0; k < 3; ++k) corners[k] = {mesh.vertices[t[k]].x, mesh.vertices[t[k]].y, mesh.vertices[t[k]].z};
    triangles.push_back(corners);
  }
  return canonical(triangles);
}

TEST(OpenMeshWriters, areReadBack) {
  using Options = OpenMesh::IO::Options;
  const TemporaryFolder folder;
  PolyMesh cube = openCube();
  cube.request_face_normals();
  cube.update_normals();
  const std::pair<const char*, Options> forms[] = {{"a.off", Options::Default},
                                                   {"a.obj", Options::Default},
                                                   {"a.ply", Options::Default},
                                                   {"b.ply", Options::Binary},
                                                   {"c.ply", Options::Binary | Options::MSB},
                                                   {"a.stl", Options::Default},
                                                   {"b.stl", Options::Binary}};
  for (const auto& [name, options] : forms) {
    ASSERT_TRUE(OpenMesh::IO::write_mesh(cube, folder.file(name), options)) << name;
    const Mesh read = readMesh(folder.file(name));
    EXPECT_EQ(cornersOf(read), cornersOf(cube)) << name;
    EXPECT_EQ(statusOf(read).summary(), "not closed (4 boundary edges)") << name;
  }
}

}  // namespace
}  // namespace copeel
