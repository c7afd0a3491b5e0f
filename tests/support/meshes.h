// Small meshes for tests, counter-clockwise seen from outside.
#pragma once

#include <cmath>
#include <memory>
#include <numbers>
#include <vector>

#include <glm/vec2.hpp>

#include "core/scene/mesh.h"

namespace copeel::test {

using MeshPointer = std::shared_ptr<const Mesh>;

inline MeshPointer share(Mesh mesh) { return std::make_shared<const Mesh>(std::move(mesh)); }

// `facets`: two triangles of a face are one facet; otherwise every triangle is its own.
inline Mesh box(const glm::dvec3& lo, const glm::dvec3& hi, bool facets = true) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1 ? hi.x : lo.x, i & 2 ? hi.y : lo.y, i & 4 ? hi.z : lo.z);
  constexpr unsigned kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (unsigned f = 0; f < 6; ++f) {
    mesh.triangles.emplace_back(kFaces[f][0], kFaces[f][1], kFaces[f][2]);
    mesh.triangles.emplace_back(kFaces[f][0], kFaces[f][2], kFaces[f][3]);
    if (facets) mesh.facets.insert(mesh.facets.end(), {f, f});
  }
  return mesh;
}

// A latitude-longitude sphere; its poles are fans.
inline Mesh sphere(double radius, unsigned columns, unsigned rows) {
  Mesh mesh;
  const auto at = [&](unsigned row, unsigned column) { return row * columns + column % columns; };
  for (unsigned r = 0; r < rows; ++r) {
    const double phi = std::numbers::pi * (r + 0.5) / rows;
    for (unsigned c = 0; c < columns; ++c) {
      const double theta = 2 * std::numbers::pi * c / columns;
      mesh.vertices.emplace_back(radius * std::sin(phi) * std::cos(theta), radius * std::sin(phi) * std::sin(theta), radius * std::cos(phi));
    }
  }
  for (unsigned c = 1; c + 1 < columns; ++c) {
    mesh.triangles.emplace_back(0, c, c + 1);
    mesh.triangles.emplace_back(at(rows - 1, 0), at(rows - 1, c + 1), at(rows - 1, c));
  }
  for (unsigned r = 0; r + 1 < rows; ++r) {
    for (unsigned c = 0; c < columns; ++c) {
      mesh.triangles.emplace_back(at(r, c), at(r + 1, c), at(r + 1, c + 1));
      mesh.triangles.emplace_back(at(r, c), at(r + 1, c + 1), at(r, c + 1));
    }
  }
  return mesh;
}

// The square [0,1]² at height z, facing up, as a fan of slivers around the corner (0, 0): `count` on each of the two far sides.
inline Mesh fanSquare(double z, unsigned count) {
  Mesh mesh;
  mesh.vertices.emplace_back(0, 0, z);
  for (unsigned i = 0; i <= count; ++i) mesh.vertices.emplace_back(1, double(i) / count, z);
  for (unsigned i = 1; i <= count; ++i) mesh.vertices.emplace_back(1 - double(i) / count, 1, z);
  for (unsigned i = 1; i <= 2 * count; ++i) mesh.triangles.emplace_back(0, i, i + 1);
  return mesh;
}

inline Mesh quad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d, bool oneFacet = true) {
  Mesh mesh;
  mesh.vertices = {a, b, c, d};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  if (oneFacet) mesh.facets = {0, 0};
  return mesh;
}

// A vertical prism over a polygon given by its corners in order (it may cross itself), from z = 0 to `height`; caps are fans of corner 0.
inline Mesh prism(const std::vector<glm::dvec2>& corners, double height) {
  Mesh mesh;
  const auto n = static_cast<unsigned>(corners.size());
  for (const glm::dvec2& c : corners) mesh.vertices.emplace_back(c.x, c.y, 0);
  for (const glm::dvec2& c : corners) mesh.vertices.emplace_back(c.x, c.y, height);
  for (unsigned i = 1; i + 1 < n; ++i) {
    mesh.triangles.emplace_back(0, i + 1, i);
    mesh.triangles.emplace_back(n, n + i, n + i + 1);
  }
  for (unsigned i = 0; i < n; ++i) {
    const unsigned j = (i + 1) % n;
    mesh.triangles.emplace_back(i, j, n + j);
    mesh.triangles.emplace_back(i, n + j, n + i);
  }
  return mesh;
}

inline Mesh flipped(Mesh mesh) {
  for (glm::uvec3& t : mesh.triangles) std::swap(t.y, t.z);
  return mesh;
}

inline Mesh joined(const Mesh& a, const Mesh& b) {
  Mesh mesh = a;
  const auto base = static_cast<unsigned>(a.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const glm::uvec3& t : b.triangles) mesh.triangles.push_back(t + glm::uvec3(base));
  mesh.facets.clear();
  return mesh;
}

}  // namespace copeel::test
