// The solids openscad makes by itself, vertex for vertex as openscad 2021.01 makes them. Null: nothing (a size of 0, say).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/scene/mesh.h"

namespace copeel::csg {

using MeshPointer = std::shared_ptr<const Mesh>;

struct Fragments {
  double fn = 0;    // $fn
  double fa = 12;   // $fa, degrees
  double fs = 2;    // $fs, model units
};

// Corners of a full circle of radius r. Throws std::length_error beyond kMaxFragments.
int fragmentCount(double r, const Fragments& fragments);
inline constexpr double kMaxFragments = 1e6;
inline constexpr double kMaxSolidCorners = 2e7;

// r · (cos, sin) of the i-th of n corners.
glm::dvec2 circlePoint(double r, int i, int n);

MeshPointer makeCube(const glm::dvec3& size, bool center);
MeshPointer makeSphere(double r, const Fragments& fragments);
MeshPointer makeCylinder(double h, double r1, double r2, bool center, const Fragments& fragments);

// Faces as lists of indices into points, clockwise from outside, one after the other; face i ends at faceEnds[i]. Indices are in range.
MeshPointer makePolyhedron(const std::vector<glm::dvec3>& points, const std::vector<std::uint32_t>& indices,
                           const std::vector<std::uint32_t>& faceEnds);

}  // namespace copeel::csg
