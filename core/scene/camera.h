// The camera as OpenSCAD 2021.01 means it: both forms of --camera, --viewall, --autocenter, --projection, vertical field of view 22.5°.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/scene/box.h"
#include "core/scene/view.h"

namespace copeel {

struct CameraOptions {
  std::vector<double> camera;         // empty, 6 numbers (eye, centre) or 7 (translate, rotate in degrees, distance)
  bool viewAll = false;               // without camera numbers, both are the default, as in openscad's PNG export
  bool autoCenter = false;
  bool perspective = true;
  int width = 512;                    // pixels
  int height = 512;
};

// The rays of the picture that openscad would take of a model with these bounds (world units).
View viewOf(const CameraOptions& options, const Box& modelBounds);

// The same camera as 7 numbers, whichever form it has; without numbers, openscad's own: 0,0,0, 55,0,25, 140.
std::vector<double> gimbalNumbers(const std::vector<double>& camera);

}  // namespace copeel
