// Flat shapes to solids: linear_extrude, rotate_extrude and the slab that stands for a flat shape in space.
#pragma once

#include <optional>

#include <glm/vec2.hpp>

#include "apps/csg/flat.h"
#include "apps/csg/solids.h"

namespace copeel::csg {

struct LinearExtrusion {
  double height = 100;
  bool center = false;
  double twist = 0;                     // degrees
  bool hasTwist = false;
  std::optional<int> slices;
  glm::dvec2 scale{1, 1};
  Fragments fragments;
};

MeshPointer extrude(const Flat& flat, const LinearExtrusion& how);

// Null where the shape lies on both sides of the axis.
MeshPointer rotateExtrude(const Flat& flat, double angle, const Fragments& fragments);
bool crossesAxis(const Flat& flat);

// What openscad's preview shows of a flat shape: z from -0.5 to 0.5.
MeshPointer slabOf(const Flat& flat);

}  // namespace copeel::csg
