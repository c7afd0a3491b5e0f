// Views and rigid motions for tests.
#pragma once

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include "core/scene/view.h"

namespace copeel::test {

inline double radians(double degrees) { return degrees * std::numbers::pi / 180; }

// Looks from `eye` to `target`; `pixel` is the size of a pixel at unit distance (perspective) or anywhere (orthographic).
inline View lookAt(const glm::dvec3& eye, const glm::dvec3& target, int width, int height, double pixel, bool perspective = true) {
  View view;
  view.width = width;
  view.height = height;
  view.perspective = perspective;
  view.eye = eye;
  view.forward = glm::normalize(target - eye);
  const glm::dvec3 up = std::abs(view.forward.z) < 0.99 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(view.forward, up));
  view.right = right * pixel;
  view.down = glm::cross(view.forward, right) * pixel;
  return view;
}

inline glm::dmat4 rotation(const glm::dvec3& degrees) {
  const auto about = [](int axis, double angle) {
    glm::dmat4 m(1.0);
    const int i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double c = std::cos(radians(angle)), s = std::sin(radians(angle));
    m[i][i] = c, m[i][j] = s, m[j][i] = -s, m[j][j] = c;
    return m;
  };
  return about(2, degrees.z) * about(1, degrees.y) * about(0, degrees.x);
}

inline glm::dmat4 translation(const glm::dvec3& by) {
  glm::dmat4 m(1.0);
  m[3] = glm::dvec4(by, 1);
  return m;
}

inline glm::dmat4 scaling(const glm::dvec3& by) {
  glm::dmat4 m(1.0);
  m[0][0] = by.x, m[1][1] = by.y, m[2][2] = by.z;
  return m;
}

// The view carried along by a rigid motion or a uniform scale.
inline View moved(View view, const glm::dmat4& m, double scale = 1) {
  const auto turn = [&](const glm::dvec3& v) { return glm::dvec3(m * glm::dvec4(v, 0)); };
  view.eye = glm::dvec3(m * glm::dvec4(view.eye, 1));
  view.forward = glm::normalize(turn(view.forward));
  view.right = turn(view.right) / (view.perspective ? scale : 1.0);
  view.down = turn(view.down) / (view.perspective ? scale : 1.0);
  return view;
}

}  // namespace copeel::test
