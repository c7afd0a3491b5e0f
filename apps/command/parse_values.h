// The values of options, from text. All functions throw Error{Usage} naming the option and what it takes.
// Numbers are read without regard to the locale; "1e3", "+5" and blanks around a number are fine.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/fold/light.h"

namespace copeel {

double parseNumber(std::string_view text, std::string_view option);

// "1,2,3"; an empty text is no list.
std::vector<double> parseNumbers(std::string_view text, std::string_view option);

// "640,480".
std::array<int, 2> parseImageSize(std::string_view text);

// "#rrggbb" or "#rgb", 0 … 255 each.
std::array<double, 3> parseColor(std::string_view text, std::string_view option);

// 0 … 1.
double parseAlpha(std::string_view text, std::string_view option);

// "1500000", "64K", "2.5G": powers of 1024.
std::uint64_t parseBytes(std::string_view text, std::string_view option);

// "X,Y,Z" or "X,Y,Z,STRENGTH": the direction towards a light in eye space.
Light parseLight(std::string_view text);

// Whether the picture is perspective: openscad's words.
bool parseProjection(std::string_view text);

// A mesh on the command line, `MESH:color=#rrggbb,alpha=0.3`. A file that has the whole text as its name is that file.
struct MeshArgument {
  std::string path;
  std::optional<std::array<double, 3>> color;   // 0 … 255
  std::optional<double> alpha;                  // 0 … 1
};
MeshArgument parseMeshArgument(const std::string& text);

}  // namespace copeel
