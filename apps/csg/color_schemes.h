// The colour schemes of openscad 2021.01, so far as a preview uses them: background, faces of the part, faces left by a cut.
#pragma once

#include <string>

#include "apps/csg/render_csg.h"

namespace copeel::csg {

// By openscad's name, in any case. Throws Error{Usage} listing the names.
ColorScheme colorScheme(const std::string& name);

// "Cornfield, Metallic, …".
std::string colorSchemeNames();

}  // namespace copeel::csg
