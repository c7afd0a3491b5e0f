// Views for validation, made without the program's camera so that a mistake there cannot hide one here.
#pragma once

#include <glm/vec3.hpp>

#include "core/scene/view.h"

namespace copeel::validation {

struct Look {
  glm::dvec3 eye{0, -10, 0};
  glm::dvec3 center{0, 0, 0};
  glm::dvec3 up{0, 0, 1};          // not parallel to the line of sight
  bool perspective = true;
  int width = 96, height = 72;     // pixels
};

// Vertical field of view 22.5°; an orthographic view shows at the centre's distance what the perspective one shows there.
View viewOf(const Look& look);

}  // namespace copeel::validation
