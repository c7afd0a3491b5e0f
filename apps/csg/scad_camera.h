// $vpt, $vpr and $vpd: a .scad may say itself from where it wants to be seen, and openscad's PNG export obeys.
#pragma once

#include <string>

#include "apps/csg/csg_model.h"
#include "apps/csg/read_model.h"
#include "core/scene/camera.h"

namespace copeel::csg {

// What the source sets takes the place of the camera's numbers, and of --viewall and --autocenter, as in openscad 2021.01. Asks openscad a
// second time (0.03 s), but only when its warning among the model's says that there is something to ask; that warning is taken out.
void applyViewVariables(const std::string& path, const ReadOptions& options, Model& model, CameraOptions& camera);

}  // namespace copeel::csg
