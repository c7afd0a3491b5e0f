#include "bench/generated_scenes.h"

#include <cmath>
#include <fstream>
#include <iterator>

#include "core/error.h"

namespace copeel::bench {
namespace {

constexpr int kPitch = 5;        // model units from hole to hole
constexpr int kBorder = 2;
constexpr int kThickness = 4;

void appendMoved(std::string& text, double x, double y, double z, const std::string& node) {
  fmt::format_to(std::back_inserter(text), "multmatrix([[1, 0, 0, {}], [0, 1, 0, {}], [0, 0, 1, {}], [0, 0, 0, 1]]) {{ {} }}\n", x, y, z, node);
}

std::string cube(double x, double y, double z) { return fmt::format("cube(size = [{}, {}, {}], center = false);", x, y, z); }

}  // namespace

PlateOfHoles plateOf(int holes, Sight sight) {
  PlateOfHoles plate;
  plate.sight = sight;
  plate.columns = static_cast<int>(std::ceil(std::sqrt(holes)));
  while (holes % plate.columns != 0) ++plate.columns;
  plate.rows = holes / plate.columns;
  return plate;
}

std::string toCsg(const PlateOfHoles& plate) {
  const int width = kPitch * plate.columns + 2 * kBorder, height = kPitch * plate.rows + 2 * kBorder;
  const std::string hole = fmt::format("cylinder($fn = {}, $fa = 12, $fs = 2, h = {}, r1 = 2, r2 = 2, center = false);", plate.sides, kThickness + 2);
  std::string text = "union() {\n";
  // The box is larger by 5 on all sides, so that no face of the plate meets one of it.
  if (plate.sight == Sight::Boxed) appendMoved(text, -5 - kBorder, -5 - kBorder, -5, cube(width + 10, height + 10, kThickness + 10));
  text += "difference() {\n";
  appendMoved(text, -kBorder, -kBorder, 0, cube(width, height, kThickness));
  for (int i = 0; i < plate.columns; ++i) {
    for (int j = 0; j < plate.rows; ++j) appendMoved(text, kPitch * (i + 0.5), kPitch * (j + 0.5), -1, hole);
  }
  return text + "}\n}\n";
}

void writeCsg(const PlateOfHoles& plate, const std::filesystem::path& file) {
  std::ofstream stream(file, std::ios::binary);
  stream << toCsg(plate);
  if (!stream.flush()) failMachine("{}: could not be written", file.string());
}

}  // namespace copeel::bench
