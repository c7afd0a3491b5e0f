#include "validation/color_oracle.h"

#include <algorithm>

namespace copeel::validation {
namespace {

// Whether each leaf takes away rather than adds: an odd number of differences subtract it. A leaf belongs to one node.
std::vector<bool> subtractedLeaves(const csg::Model& model) {
  std::vector<bool> nodeSubtracted(model.nodes.size(), false), leaf(model.leaves.size(), false);
  for (std::size_t n = model.nodes.size(); n-- > 0;) {
    const csg::Node& node = model.nodes[n];
    if (node.operation == csg::Operation::Leaf) leaf[node.leaf] = nodeSubtracted[n];
    for (std::uint32_t i = 0; i < node.childCount; ++i)
      nodeSubtracted[model.childIndices[node.firstChild + i]] = nodeSubtracted[n] != (node.operation == csg::Operation::Difference && i > 0);
  }
  return leaf;
}

std::vector<glm::dvec4> colorsOf(const csg::Model& model, const csg::ColorScheme& scheme) {
  const std::vector<bool> subtracted = subtractedLeaves(model);
  std::vector<glm::dvec4> colors;
  for (std::size_t i = 0; i < model.leaves.size(); ++i) {
    const auto& plain = subtracted[i] ? scheme.cutout : scheme.front;
    glm::dvec4 color(plain[0], plain[1], plain[2], 1);
    if (const auto& own = model.leaves[i].color) {
      for (int k = 0; k < 3; ++k) color[k] = (*own)[k] < 0 ? color[k] : (*own)[k] * 255;
      color.a = own->a;
    }
    colors.push_back(color);
  }
  return colors;
}

// The model with an empty mesh for each translucent leaf that adds.
csg::Model opaqueShare(csg::Model model) {
  const std::vector<bool> subtracted = subtractedLeaves(model);
  for (std::size_t i = 0; i < model.leaves.size(); ++i)
    if (!subtracted[i] && model.leaves[i].color && model.leaves[i].color->a < 1) model.leaves[i].mesh = std::make_shared<Mesh>();
  return model;
}

}  // namespace

ColorOracle::ColorOracle(const csg::Model& model, const View& view, const csg::ColorScheme& scheme)
    : leafColors_(colorsOf(model, scheme)),
      background_(scheme.background[0], scheme.background[1], scheme.background[2]),
      whole_(model, view),
      opaque_(opaqueShare(model), view, {whole_.tolerance(), csg::InsideRule::NonZero, {}}) {}

glm::dvec3 ColorOracle::color(const Ray& ray) const {
  // The first opaque entry of the opaque share ends the ray; it may also be an entry of the whole, at the same depth.
  std::vector<Seen> entries;
  for (const auto& change : whole_.changes(ray))
    if (change.entering) entries.push_back(change.seen);
  for (const auto& change : opaque_.changes(ray)) {
    if (!change.entering || leafColors_[change.seen.leaf].a < 1) continue;
    entries.push_back(change.seen);
    break;
  }
  // At one depth the whole's face lies in front: it was put first.
  std::stable_sort(entries.begin(), entries.end(), [&](const Seen& a, const Seen& b) { return a.depth < b.depth - whole_.tolerance(); });

  glm::dvec3 sum(0);
  double through = 1;
  for (const Seen& entry : entries) {
    const glm::dvec4& color = leafColors_[entry.leaf];
    sum += glm::dvec3(color) * (color.a * through);
    through *= 1 - color.a;
    if (through <= 0) break;
  }
  return sum + background_ * through;
}

}  // namespace copeel::validation
