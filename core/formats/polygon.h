// Cuts a polygon in space into triangles: a strictly convex one as a fan, any other by clipping ears in its own plane.
// n corners always give n - 2 triangles that use every corner and keep the polygon's orientation; collinear corners stay (they close T-junctions).
// Cost: O(n) for a convex polygon and, by a grid of the reflex corners, for the common others; O(n · reflex corners) at worst.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "core/formats/point_grid.h"

namespace copeel {

class PolygonCutter {
 public:
  enum class Result {
    Planar,      // all triangles lie in one plane, within the rounding of the input
    NotPlanar,   // no such plane: cut as seen along the polygon's mean normal
    TooComplex,  // the work allowed to all polygons of a file is spent; no triangles
  };

  // At least 3 corners. singlePrecision: the coordinates were rounded to float32 before they came here.
  Result cut(std::span<const glm::dvec3> corners, bool singlePrecision);
  // Of the last cut, as indices of its corners.
  const std::vector<glm::uvec3>& triangles() const { return triangles_; }

 private:
  void project(std::span<const glm::dvec3> corners, const glm::dvec3& normal);
  bool isStrictlyConvex() const;
  void fan(std::uint32_t apex);
  bool clipEars();
  void fanRing(std::uint32_t apex);
  double turn(std::uint32_t corner) const;
  bool isEar(std::uint32_t corner);
  void clip(std::uint32_t corner);

  std::vector<glm::dvec2> points_;              // the corners in the polygon's plane, counter-clockwise
  std::vector<std::uint32_t> previous_, next_;  // the ring of corners not yet clipped
  PointGrid reflex_;                            // corners that were not convex at first: only they can lie in an ear
  std::vector<std::uint8_t> clipped_;
  std::vector<glm::uvec3> triangles_;
  std::uint64_t workLeft_ = 500'000'000;  // corners looked at; a few seconds
};

}  // namespace copeel
