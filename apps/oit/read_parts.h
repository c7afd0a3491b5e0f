// Meshes of the command line to parts: the files' geometry, and the colour and opacity of each face.
//
// Colour and opacity are looked for apart, and the first that says something wins: the mesh's own look on the command line
// (MESH:color=…,alpha=…), --color and --alpha, the file (materials of an OBJ, colours of a PLY), and at last a colour of a palette that tells
// parts apart, and 0.5.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "apps/command/parse_values.h"
#include "apps/oit/render_oit.h"

namespace copeel::oit {

struct CommonLook {
  std::optional<std::array<double, 3>> color;   // --color, 0 … 255
  std::optional<double> alpha;                  // --alpha
};

inline constexpr float kDefaultAlpha = 0.5f;    // whoever asks for transparency wants to see through

// One part an argument, in their order; a file named twice is read once. Warnings are one line each. Throws Error{Input}.
std::vector<Part> readParts(const std::vector<MeshArgument>& files, const CommonLook& look, std::vector<std::string>& warnings);

}  // namespace copeel::oit
