#include "apps/csg/color_schemes.h"

#include <algorithm>
#include <cctype>
#include <string_view>

#include "core/error.h"

namespace copeel::csg {
namespace {

struct NamedScheme {
  std::string_view name;
  ColorScheme scheme;
};

// In the order of openscad's own list.
constexpr NamedScheme kSchemes[] = {
    {"Cornfield", {{255, 255, 229}, {249, 215, 44}, {157, 203, 81}}},
    {"Metallic", {{170, 170, 255}, {221, 221, 255}, {221, 34, 221}}},
    {"Sunset", {{170, 68, 68}, {255, 170, 170}, {136, 34, 51}}},
    {"Starnight", {{0, 0, 0}, {255, 255, 224}, {0, 255, 255}}},
    {"BeforeDawn", {{51, 51, 51}, {204, 204, 204}, {85, 99, 221}}},
    {"Nature", {{250, 250, 250}, {22, 160, 133}, {219, 244, 218}}},
    {"DeepOcean", {{51, 51, 51}, {238, 238, 238}, {11, 171, 200}}},
    {"Solarized", {{253, 246, 227}, {181, 136, 0}, {136, 34, 51}}},
    {"Tomorrow", {{248, 248, 248}, {66, 113, 174}, {245, 135, 31}}},
    {"Tomorrow Night", {{29, 31, 33}, {129, 162, 190}, {222, 147, 95}}},
    {"Monotone", {{255, 255, 229}, {249, 215, 44}, {249, 215, 44}}},
};

bool equalInAnyCase(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

ColorScheme colorScheme(const std::string& name) {
  for (const NamedScheme& entry : kSchemes) {
    if (equalInAnyCase(entry.name, name)) return entry.scheme;
  }
  failUsage("--colorscheme takes one of {}, not '{}'", colorSchemeNames(), name);
}

std::string colorSchemeNames() {
  std::string names;
  for (const NamedScheme& entry : kSchemes) names.append(names.empty() ? "" : ", ").append(entry.name);
  return names;
}

}  // namespace copeel::csg
