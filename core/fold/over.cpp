#include "core/fold/over.h"

#include <cmath>

#include <glm/geometric.hpp>

#include "core/parallel.h"

namespace copeel::fold {

void OverTables::addObject(const vec4& color) {
  ranges.push_back({static_cast<std::uint32_t>(bases.size()), 0});
  bases.push_back(color);
}

void OverTables::addObject(std::span<const vec4> colorOfTriangle) {
  ranges.push_back({static_cast<std::uint32_t>(bases.size()), 1});
  bases.insert(bases.end(), colorOfTriangle.begin(), colorOfTriangle.end());
}

std::vector<float> shadesOf(const PlaneClasses& planes, const View& view, bool lit) {
  constexpr double kAmbient = 0.2;
  const glm::dvec3 right = glm::normalize(view.right), up = -glm::normalize(view.down);
  const glm::dvec3 light = (-right + up - view.forward) / std::sqrt(3.0);
  std::vector<float> shades(planes.classes().size(), 1.0f);
  if (!lit) return shades;
  parallelFor(shades.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      shades[i] = static_cast<float>(kAmbient + std::abs(glm::dot(planes.classes()[i].normal, light)));
    }
  });
  return shades;
}

}  // namespace copeel::fold
