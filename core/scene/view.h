// The rays of an image: what is left of a camera when it meets pixels. Everything the rasterizer and the exact order know of it.
//
// The sample of pixel (x, y), x to the right and y down from the upper left corner, has the ray
//   perspective:  eye + t · (forward + u · right + v · down)
//   orthographic: eye + u · right + v · down + t · forward
// with u = x + 0.5 + offset.x - width/2 and v = y + 0.5 + offset.y - height/2 in pixels. As forward is a unit vector orthogonal to right and
// down, t is the distance along the view axis in model units.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace copeel {

struct View {
  int width = 512;                        // pixels, 1 … 16384
  int height = 512;
  bool perspective = true;
  glm::dvec3 eye{0, 0, 1};                // world units
  glm::dvec3 forward{0, 0, -1};           // unit
  glm::dvec3 right{1, 0, 0};              // one pixel to the right; at unit distance (perspective) or anywhere (orthographic)
  glm::dvec3 down{0, -1, 0};              // one pixel down, likewise
  glm::dvec2 offset{0, 0};                // of the sample within its pixel, in pixels, a multiple of 2^-16 below 0.5; for anti-aliasing
};

}  // namespace copeel
