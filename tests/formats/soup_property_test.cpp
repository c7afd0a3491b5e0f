// Any soup, written in any format and read back, is the same soup: duplicates, non-manifold and degenerate faces, unreferenced vertices included.
// The writers here are the tests' own and share nothing with the readers.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>

#include "mesh_texts.h"

namespace copeel {
namespace {

// Any finite double, by its bits, so that denormals and the largest ones come as often as others; or small integers, which coincide.
rc::Gen<double> anyCoordinate(bool single) {
  const auto bits = rc::gen::map(rc::gen::arbitrary<std::uint64_t>(), [single](std::uint64_t b) {
    const double value = single
                             ? double{std::bit_cast<float>(static_cast<std::uint32_t>(b * 0x9e3779b97f4a7c15u >> 32))}
                             : std::bit_cast<double>(b * 0x9e3779b97f4a7c15u);
    return std::isfinite(value) ? value : 1.0;
  });
  return rc::gen::oneOf(bits, rc::gen::map(rc::gen::inRange(-2, 3), [](int i) { return double(i); }));
}

Mesh anySoup(bool single) {
  Mesh mesh;
  const int vertexCount = *rc::gen::inRange(1, 12), triangleCount = *rc::gen::inRange(0, 30);
  const auto coordinate = anyCoordinate(single);
  for (int i = 0; i < vertexCount; ++i) {
    const double x = *coordinate, y = *coordinate, z = *coordinate;
    mesh.vertices.emplace_back(x, y, z);
  }
  const auto index = rc::gen::inRange<std::uint32_t>(0, vertexCount);
  for (int i = 0; i < triangleCount; ++i) {
    const std::uint32_t a = *index, b = *index, c = *index;
    mesh.triangles.emplace_back(a, b, c);
  }
  mesh.singlePrecision = single;
  return mesh;
}

std::string offOf(const Mesh& mesh) {
  std::string text = fmt::format("OFF\n{} {} 0\n", mesh.vertices.size(), mesh.triangles.size());
  for (const glm::dvec3& v : mesh.vertices) text += fmt::format("{} {} {}\n", v.x, v.y, v.z);
  for (const glm::uvec3& t : mesh.triangles) text += fmt::format("3 {} {} {}\n", t.x, t.y, t.z);
  return text;
}

std::string objOf(const Mesh& mesh) {
  std::string text = "# soup\n";
  for (const glm::dvec3& v : mesh.vertices) text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", v.x, v.y, v.z);
  for (const glm::uvec3& t : mesh.triangles) text += fmt::format("f {}//1 {}//1 {}//1\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

std::string plyOf(const Mesh& mesh, const std::string& format) {
  const std::string type = mesh.singlePrecision ? "float" : "double";
  std::string text = fmt::format("ply\nformat {} 1.0\nelement vertex {}\n", format, mesh.vertices.size());
  for (const char axis : {'x', 'y', 'z'}) text += fmt::format("property {} {}\n", type, axis);
  text += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangles.size());
  const bool ascii = format == "ascii", big = format == "binary_big_endian";
  const auto coordinate = [&](double value) {
    if (ascii) return fmt::format("{} ", value);
    return mesh.singlePrecision ? bytesOf(static_cast<float>(value), big) : bytesOf(value, big);
  };
  const auto index = [&](std::uint32_t value) { return ascii ? fmt::format("{} ", value) : bytesOf(value, big); };
  for (const glm::dvec3& v : mesh.vertices) text += coordinate(v.x) + coordinate(v.y) + coordinate(v.z);
  for (const glm::uvec3& t : mesh.triangles) text += (ascii ? "3 " : "\3") + index(t.x) + index(t.y) + index(t.z);
  return text;
}

std::string asciiStlOf(const Mesh& mesh) {
  std::string text = "solid soup\n";
  for (const glm::uvec3& t : mesh.triangles) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3& v = mesh.vertices[t[i]];
      text += fmt::format("vertex {} {} {}\n", v.x, v.y, v.z);
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid soup\n";
}

std::string binaryStlOf(const Mesh& mesh) {
  std::string bytes = std::string(80, ' ') + bytesOf(static_cast<std::uint32_t>(mesh.triangles.size()));
  for (const glm::uvec3& t : mesh.triangles) {
    bytes += std::string(12, '\0');
    for (int i = 0; i < 3; ++i) {
      for (int axis = 0; axis < 3; ++axis) bytes += bytesOf(static_cast<float>(mesh.vertices[t[i]][axis]));
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

void checkSame(const Mesh& read, const Mesh& written) {
  RC_ASSERT(read.vertices == written.vertices);
  RC_ASSERT(read.triangles == written.triangles);
  RC_ASSERT(read.facets.empty());
}

// Formats without indices: the positions of the corners are what must survive.
void checkSameCorners(const Mesh& read, const Mesh& written) {
  RC_ASSERT(read.triangles.size() == written.triangles.size());
  for (std::size_t i = 0; i < read.triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      RC_ASSERT(read.vertices[read.triangles[i][corner]] == written.vertices[written.triangles[i][corner]]);
    }
  }
}

RC_GTEST_PROP(SoupProperty, offKeepsAll, ()) {
  const Mesh soup = anySoup(false);
  checkSame(meshOf(offOf(soup)), soup);
}

RC_GTEST_PROP(SoupProperty, objKeepsAll, ()) {
  const Mesh soup = anySoup(false);
  checkSame(meshOf(objOf(soup)), soup);
}

RC_GTEST_PROP(SoupProperty, plyKeepsAll, (bool single)) {
  const Mesh soup = anySoup(single);
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    const Mesh read = meshOf(plyOf(soup, format));
    checkSame(read, soup);
    RC_ASSERT(read.singlePrecision == single);
  }
}

RC_GTEST_PROP(SoupProperty, stlKeepsAll, ()) {
  const Mesh soup = anySoup(false), singles = anySoup(true);
  checkSameCorners(meshOf(asciiStlOf(soup)), soup);
  checkSameCorners(meshOf(binaryStlOf(singles)), singles);
}

// Cutting a file anywhere, or changing a byte, gives a mesh or one line; nothing else may happen.
RC_GTEST_PROP(SoupProperty, damagedFilesAreAnsweredInOneLine, (bool single)) {
  const Mesh soup = anySoup(single);
  std::string bytes = *rc::gen::element(offOf(soup), objOf(soup), plyOf(soup, "ascii"),
                                        plyOf(soup, "binary_little_endian"), asciiStlOf(soup), binaryStlOf(soup));
  const auto place = *rc::gen::inRange<std::size_t>(0, bytes.size());
  if (*rc::gen::arbitrary<bool>()) {
    bytes.resize(place);
  } else {
    bytes[place] = *rc::gen::arbitrary<char>();
  }
  RC_ASSERT(faultOf(bytes).find('\n') == std::string::npos);
}

// What the status says does not depend on the order of triangles or on how vertices are shared.
RC_GTEST_PROP(MeshStatusProperty, sharingVerticesChangesNothing, ()) {
  Mesh soup = anySoup(false);
  const MeshStatus shared = statusOf(soup);
  Mesh own;
  for (const glm::uvec3& t : soup.triangles) {
    const auto n = static_cast<std::uint32_t>(own.vertices.size());
    for (int i = 0; i < 3; ++i) own.vertices.push_back(soup.vertices[t[i]]);
    own.triangles.insert(own.triangles.begin(), {n, n + 1, n + 2});
  }
  const MeshStatus separate = statusOf(own);
  RC_ASSERT(shared.closed == separate.closed);
  RC_ASSERT(shared.boundaryEdgeCount == separate.boundaryEdgeCount);
  RC_ASSERT(shared.nonManifoldEdgeCount == separate.nonManifoldEdgeCount);
  RC_ASSERT(shared.inconsistentEdgeCount == separate.inconsistentEdgeCount);
  RC_ASSERT(shared.degenerateTriangleCount == separate.degenerateTriangleCount);
  RC_ASSERT(shared.duplicateTriangleCount == separate.duplicateTriangleCount);
}

}  // namespace
}  // namespace copeel
