// Colours by name (those of CSS, as openscad knows them) and as #rgb, #rgba, #rrggbb, #rrggbbaa.
#pragma once

#include <optional>
#include <string_view>

#include <glm/vec4.hpp>

namespace copeel::csg {

std::optional<glm::dvec4> namedColor(std::string_view name);   // components 0 … 1

}  // namespace copeel::csg
