// Polygons with holes to triangles, in the plane: a constrained Delaunay triangulation.
//
// Based on: Sloan. A fast algorithm for generating constrained Delaunay triangulations. Computers & Structures 1993.
// Orientations are exact, so loops may touch themselves and each other in corners and
// along edges; loops that cross are refused. The inside is where a ray meets the loops an odd number of times. Cost: O(n^1.5) at worst in
// practice; no recursion.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace copeel::csg {

// Loop i ends at loopEnds[i]. Triangles are indices of points, counter-clockwise. None where loops cross, or reach beyond 1e301.
std::optional<std::vector<glm::uvec3>> triangulate(std::span<const glm::dvec2> points, std::span<const std::uint32_t> loopEnds);

}  // namespace copeel::csg
