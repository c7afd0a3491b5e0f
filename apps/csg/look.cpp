// Colours of leaves and parts, and their blending.
#include "apps/csg/look.h"

#include <algorithm>

#include <glm/common.hpp>

namespace copeel::csg {
namespace {

// openscad's colours of what carries % and #, 0 … 255 and alpha.
const glm::dvec4 kBackgroundPart(180, 180, 180, 128.0 / 255);
const glm::dvec4 kHighlightPart(glm::dvec3(kHighlightColor) * 255.0, kHighlightColor.a);

// Channel by channel, the leaf's own where it has one.
glm::dvec4 painted(const Leaf& leaf, glm::dvec4 color) {
  if (!leaf.color) return color;
  for (int i = 0; i < 3; ++i) {
    if ((*leaf.color)[i] >= 0) color[i] = (*leaf.color)[i] * 255;
  }
  color.a = leaf.color->a;
  return color;
}

glm::dvec3 toVector(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }

}  // namespace

Look::Look(const Model& model, const GateForest& forest, const RenderOptions& options) : model_(model), options_(options) {
  for (std::size_t leaf = 0; leaf < forest.cuts.size(); ++leaf) {
    const glm::dvec4 plain(toVector(forest.cuts[leaf] ? options.scheme.cutout : options.scheme.front), 1);
    leafColors_.push_back(leaf < model.leaves.size() ? painted(model.leaves[leaf], plain) : plain);
  }
}

glm::dvec4 Look::overlayColor(std::uint32_t leaf, std::uint32_t part) const {
  return part <= model_.background.size() ? painted(model_.leaves[leaf], kBackgroundPart) : kHighlightPart;
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
