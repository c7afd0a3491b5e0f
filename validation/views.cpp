#include "validation/views.h"

#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

namespace copeel::validation {

View viewOf(const Look& look) {
  constexpr double kHalfFieldOfView = 11.25 * std::numbers::pi / 180;
  View view;
  view.width = look.width;
  view.height = look.height;
  view.perspective = look.perspective;
  view.eye = look.eye;
  view.forward = glm::normalize(look.center - look.eye);
  double pixel = std::tan(kHalfFieldOfView) / (look.height * 0.5);
  if (!look.perspective) pixel *= glm::length(look.center - look.eye);
  const glm::dvec3 right = glm::normalize(glm::cross(view.forward, look.up));
  view.right = right * pixel;
  view.down = glm::cross(view.forward, right) * pixel;
  return view;
}

}  // namespace copeel::validation
