// The real openscad: its preview as a picture (under a virtual X server), its exact render as a mesh.
// OFF files from openscad carry six significant digits: meshes are exact only where the coordinates are that short.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "core/scene/mesh.h"

namespace copeel::validation {

// Whether openscad, and xvfb-run for its preview, can be started.
bool openscadIsHere();

// The preview PNG of a .csg or .scad text, with openscad's own command-line options ("--imgsize=400,300", "--camera=…"). Nothing when openscad fails.
std::optional<Image<Rgb8>> openscadPreview(const std::string& text, const std::vector<std::string>& options);

// The mesh of openscad's exact render. Nothing when openscad fails or the solid is empty.
std::optional<Mesh> openscadRender(const std::string& text);

}  // namespace copeel::validation
