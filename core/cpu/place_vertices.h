// Vertices to the sub-pixel grid, in batches, vectorised with run-time dispatch: each target does the same operations in the same order.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace copeel::cpu {

// From object coordinates through camera's to pixels from the view axis, and to grid coordinates: p.x / w of transformPoint and Camera
// (projection.cpp), snapped as there.
struct Placement {
  glm::dmat4 worldFromObject;
  glm::dvec3 eye, right, down, forward;
  bool perspective;
  double nearest;              // perspective: what is nearer is behind
  double limitX, limitY;       // largest |x|, |y| that fits the grid
  double originX, originY;     // of sample (0, 0)
  double scale;                // grid steps to a pixel
};

// x = kOffGrid where a vertex does not fit. True: some lie behind.
bool placeVertices(const Placement& placement, std::span<const glm::dvec3> vertices, glm::ivec2* out);

}  // namespace copeel::cpu
