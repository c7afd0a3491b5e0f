// A soup of triangles: the truth about a shape as its file gave it. Nothing is welded, repaired or dropped.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/scene/box.h"

namespace copeel {

struct Mesh {
  std::vector<glm::dvec3> vertices;    // model units
  std::vector<glm::uvec3> triangles;   // indices into vertices, counter-clockwise seen from outside
  // Facet of each triangle, 0 … facetCount-1, never decreasing; the triangles of a facet lie in one plane by construction (the
  // two halves of a cube's face). Empty: every triangle is a facet of its own.
  std::vector<std::uint32_t> facets;
  // Of each triangle, 0 … 255 and alpha 0 … 1, where the file gives any and the reader was asked to keep them; else empty. A colour that
  // a triangle lacks has red kNotGiven, an alpha that it lacks is kNotGiven.
  std::vector<glm::vec4> colors;
  static constexpr float kNotGiven = -1;
  bool singlePrecision = false;        // the coordinates were float32 in the file: they agree to a few float ulp only

  std::size_t facetCount() const { return facets.empty() ? triangles.size() : std::size_t{facets.back()} + 1; }
  std::uint32_t facetOf(std::size_t triangle) const {
    return facets.empty() ? static_cast<std::uint32_t>(triangle) : facets[triangle];
  }
};

// For each vertex, whether a triangle uses it: 1 or 0.
std::vector<std::uint8_t> usedVertices(const Mesh& mesh);

Box boundingBox(const Mesh& mesh);   // of the vertices that are used

}  // namespace copeel
