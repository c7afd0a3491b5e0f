// Colours of leaves and parts, and their blending.
#include "apps/csg/look.h"

#include <algorithm>

#include <glm/common.hpp>

namespace copeel::csg {
namespace {

// openscad's colours of what carries % and #, 0 … 255 and alpha.
const glm::dvec4 kBackgroundPart(180, 180, 180, 128.0 / 255);
const glm::dvec4 kHighlightPart(255, 81, 81, 128.0 / 255);

glm::dvec3 toVector(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }

}  // namespace

Look::Look(const Model& model, const GateForest& forest, const RenderOptions& options) : model_(model), options_(options) {
  for (std::size_t leaf = 0; leaf < forest.cuts.size(); ++leaf) {
    const bool colored = leaf < model.leaves.size() && model.leaves[leaf].color;
    const glm::dvec4 own = colored ? *model.leaves[leaf].color * glm::dvec4(255, 255, 255, 1) : glm::dvec4(0);
    leafColors_.push_back(colored ? own : glm::dvec4(toVector(forest.cuts[leaf] ? options.scheme.cutout : options.scheme.front), 1));
  }
}

glm::dvec4 Look::overlayColor(std::uint32_t part) const {
  return part <= model_.background.size() ? kBackgroundPart : kHighlightPart;
}

glm::dvec3 Look::blend(std::span<const Surface> frontToBack) const {
  glm::dvec3 sum(0);
  double through = 1;
  for (const Surface& surface : frontToBack) {
    const glm::dvec4 color = colorOf(surface.leaf, surface.part);
    const double alpha = std::clamp(color.a, 0.0, 1.0);
    // openscad's light can be brighter than white: each channel stops at its own limit, so that yellow turns paler before it is full.
    const glm::dvec3 lit = glm::min(glm::dvec3(color) * double(shade_[surface.planeClass]), 255.0);
    sum += lit * (alpha * through);
    through *= 1 - alpha;
  }
  return sum + toVector(options_.scheme.background) * through;
}

}  // namespace copeel::csg
