// Flat shapes (square, circle, polygon and their Booleans), made by Clipper the way openscad 2021.01 makes them: what passes through
// an operation lies on a grid of 2^-16, what does not keeps its doubles.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/vec2.hpp>

#include "apps/csg/csg_syntax.h"
#include "apps/csg/external.h"
#include "apps/csg/mesh_builder.h"

namespace copeel::csg {

struct Outline {
  std::vector<glm::dvec2> points;
  bool positive = true;               // false: a hole
};

struct Flat {
  std::vector<Outline> outlines;
  bool sanitized = false;             // outlines do not cross; outer ones run counter-clockwise, holes clockwise

  bool empty() const { return outlines.empty(); }
  std::size_t pointCount() const;
};

// The union of the children of an extrusion, or the shape of one flat node.
Flat flatOfChildren(const SyntaxTree& tree, std::uint32_t node, const ExternalShapes& external, std::vector<std::string>& warnings);
Flat flatOfNode(const SyntaxTree& tree, std::uint32_t node, const ExternalShapes& external, std::vector<std::string>& warnings);

// Adds the outlines' points with `place` (dvec2 → dvec3), and returns the index of each outline's first vertex.
template <class Place>
std::vector<std::uint32_t> addOutlines(MeshBuilder& builder, const Flat& flat, Place place) {
  std::vector<std::uint32_t> firsts;
  for (const Outline& outline : flat.outlines) {
    firsts.push_back(static_cast<std::uint32_t>(-1));
    for (const glm::dvec2& point : outline.points) {
      const std::uint32_t index = builder.addVertex(place(point));
      if (firsts.back() == static_cast<std::uint32_t>(-1)) firsts.back() = index;
    }
  }
  return firsts;
}

// The triangles of the area between the outlines, indices counting the points of all outlines in a row.
std::vector<glm::uvec3> areaOf(const Flat& flat);

// One facet over vertices that stand in a row from firstVertex on, in the order of areaOf.
void addArea(MeshBuilder& builder, const std::vector<glm::uvec3>& area, std::uint32_t firstVertex, bool reversed);

}  // namespace copeel::csg
