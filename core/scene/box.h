// An axis-aligned box; empty when any lower bound exceeds its upper one.
#pragma once

#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace copeel {

struct Box {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return min.x > max.x || min.y > max.y || min.z > max.z; }
  void add(const glm::dvec3& point) {
    min = glm::min(min, point);
    max = glm::max(max, point);
  }
  void add(const Box& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  glm::dvec3 center() const { return empty() ? glm::dvec3(0) : (min + max) * 0.5; }
  double diagonal() const { return empty() ? 0.0 : glm::length(max - min); }
};

}  // namespace copeel
