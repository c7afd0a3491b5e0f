// Lights far away, in eye space, so that they stay with the camera: what --light says.
#pragma once

#include <vector>

#include <glm/vec3.hpp>

namespace copeel {

struct Light {
  glm::dvec3 toward{-1, 1, 1};   // towards the light, of any length but 0: x to the right, y up, z to the viewer
  double strength = 1;           // what a face at right angles to it gets
};

// openscad's preview has two, of which its shader for CSG products counts the first alone.
inline std::vector<Light> openscadLights() { return {Light{}}; }

}  // namespace copeel
