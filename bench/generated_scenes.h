// Models too large for openscad to write in reasonable time, as .csg text in its own words: plates with any number of holes.
#pragma once

#include <filesystem>
#include <string>

namespace copeel::bench {

enum class Sight {
  Open,     // every hole is seen
  Boxed,    // a closed box around the plate hides all of it
};

struct PlateOfHoles {
  int columns = 10, rows = 10;
  int sides = 16;               // of a hole; 4 · sides - 4 triangles
  Sight sight = Sight::Open;
};

// As near to a plate of 8 to 5 as `holes` can be divided; a power of ten always can.
PlateOfHoles plateOf(int holes, Sight sight);

std::string toCsg(const PlateOfHoles& plate);
void writeCsg(const PlateOfHoles& plate, const std::filesystem::path& file);

}  // namespace copeel::bench
