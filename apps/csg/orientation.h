// How points of the plane lie to each other.
#pragma once

#include <span>

#include <glm/vec2.hpp>

namespace copeel::csg {

// Positive where a, b, c turn left. The sign is exact.
double orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c);

// Positive where d lies within the circle through a, b, c (a left turn), 0 where that is within rounding.
double inCircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d);

// One loop, each corner a left turn, once around.
bool isConvexLoop(std::span<const glm::dvec2> points);

}  // namespace copeel::csg
