// What the oracle casts rays at: closed or open triangle soups with exact coordinates.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <gmpxx.h>

#include "apps/csg/csg_model.h"
#include "core/scene/box.h"

namespace copeel::validation {

using ExactPoint = std::array<mpq_class, 3>;

struct OracleMesh {
  std::vector<glm::dvec3> vertices;        // world units
  std::vector<ExactPoint> exactVertices;   // empty: the doubles are exact; else as many as vertices, which are then roundings
  std::vector<glm::uvec3> triangles;       // counter-clockwise seen from outside

  ExactPoint exactVertex(std::uint32_t index) const;
};

Box boundsOf(const OracleMesh& mesh);

// Every directed edge is met by as many opposite ones, edges being compared by exact position.
bool isClosed(const OracleMesh& mesh);

// Leaf `index` of a model in world units, rounded as the whole program rounds (transformPoint); a mirror keeps outside outside.
OracleMesh leafMesh(const csg::Model& model, std::uint32_t index);

// The mesh turned by an affine matrix whose doubles are taken as exact: no rounding at all.
OracleMesh transformedExactly(const OracleMesh& mesh, const glm::dmat4& matrix);

}  // namespace copeel::validation
