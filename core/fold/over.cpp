#include "core/fold/over.h"

#include <algorithm>
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

namespace {

// A light's direction in world space, as long as the light is strong. Only the ratio of its numbers counts, which may themselves be too large to square.
glm::dvec3 weighted(const Light& light, const View& view) {
  const double greatest = std::max({std::abs(light.toward.x), std::abs(light.toward.y), std::abs(light.toward.z)});
  const glm::dvec3 toward = light.toward / greatest;
  const glm::dvec3 right = glm::normalize(view.right), up = -glm::normalize(view.down);
  return (toward.x * right + toward.y * up - toward.z * view.forward) / glm::length(toward) * light.strength;
}

// Of a group's classes; in this form compilers make vectors of it.
void addShades(const PlaneClassGroup& group, const glm::dvec3& light, double (&shades)[PlaneClassGroup::kSize]) {
  const auto& n = group.normal;
  for (std::size_t i = 0; i < PlaneClassGroup::kSize; ++i) shades[i] += std::abs(n[0][i] * light.x + n[1][i] * light.y + n[2][i] * light.z);
}

}  // namespace

Shades shadesOf(const PlaneClasses& planes, const View& view, bool lit, const std::vector<Light>& lights) {
  constexpr double kAmbient = 0.2;
  if (!lit) return Shades(planes.classes().size(), 1.0f);
  Shades shades(planes.classes().size());
  std::vector<glm::dvec3> directions;
  for (const Light& light : lights) directions.push_back(weighted(light, view));
  constexpr std::size_t kSize = PlaneClassGroup::kSize;
  parallelFor((shades.size() + kSize - 1) / kSize, 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g != end; ++g) {
      double sums[kSize];
      std::fill_n(sums, kSize, kAmbient);
      for (const glm::dvec3& light : directions) addShades(planes.classes().groups()[g], light, sums);
      std::copy_n(sums, std::min(kSize, shades.size() - g * kSize), shades.begin() + g * kSize);
    }
  });
  return shades;
}

}  // namespace copeel::fold
