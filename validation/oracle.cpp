#include "validation/oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <glm/geometric.hpp>

namespace copeel::validation {
namespace {

constexpr double kDeclaredTolerance = 1e-10;   // of the scene's diagonal, DESIGN.md
constexpr double kLeastUlps = 16;              // of the largest coordinate: below that a turned vertex does not find its plane again

bool contains(const Box& box, const glm::dvec3& p) {
  return !box.empty() && glm::all(glm::lessThanEqual(box.min, p)) && glm::all(glm::lessThanEqual(p, box.max));
}

// A closed box as a leaf.
csg::Leaf boxLeaf(const glm::dvec3& low, const glm::dvec3& high) {
  auto mesh = std::make_shared<Mesh>();
  for (int i = 0; i < 8; ++i) mesh->vertices.push_back({i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z});
  mesh->triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return {mesh, glm::dmat4(1.0), std::nullopt};
}

}  // namespace

double declaredTolerance(const Box& bounds) {
  if (bounds.empty()) return 0;
  double largest = 0;
  for (int i = 0; i < 3; ++i) largest = std::max({largest, std::abs(bounds.min[i]), std::abs(bounds.max[i])});
  const double ulp = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  return std::max(kDeclaredTolerance * bounds.diagonal(), kLeastUlps * ulp);
}

double generalisedWinding(const OracleMesh& mesh, const glm::dvec3& point) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.vertices[t.x] - point, b = mesh.vertices[t.y] - point, c = mesh.vertices[t.z] - point;
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    const double bottom = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
    sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)), bottom);
  }
  return sum / (4 * std::numbers::pi);
}

Box boundsOf(const csg::Model& model) {
  Box box;
  for (std::uint32_t i = 0; i < model.leaves.size(); ++i) box.add(boundsOf(leafMesh(model, i)));
  return box;
}

CsgOracle::CsgOracle(const csg::Model& model, const View& view, const CsgOracleOptions& options) : model_(model), options_(options) {
  const Box bounds = boundsOf(model);
  diagonal_ = bounds.diagonal();
  tolerance_ = options.tolerance < 0 ? declaredTolerance(bounds) : options.tolerance;
  addSections(options.sections);
  for (std::uint32_t i = 0; i < model_.leaves.size(); ++i) {
    leaves_.push_back(leafMesh(model_, i));
    closed_.push_back(isClosed(leaves_.back()));
    // Only an open leaf that may hold the eye has a winding number that its crossings do not tell.
    const bool ask = !closed_.back() && view.perspective && contains(boundsOf(leaves_.back()), view.eye);
    openWindingAtEye_.push_back(ask ? int(std::lround(generalisedWinding(leaves_.back(), view.eye))) : 0);
  }
  caster_ = std::make_unique<RayCaster>(leaves_, view);
}

// A section subtracts a box that begins at the plane and holds everything beyond it.
void CsgOracle::addSections(const std::vector<csg::Section>& sections) {
  if (sections.empty() || model_.root == csg::kNoNode) return;
  Box bounds = boundsOf(model_);
  const glm::dvec3 room(bounds.diagonal() + 1);
  bounds.min -= room;
  bounds.max += room;

  const auto firstChild = std::uint32_t(model_.childIndices.size());
  model_.childIndices.push_back(model_.root);
  for (const csg::Section& section : sections) {
    glm::dvec3 low = bounds.min;
    low[section.axis] = section.at;
    if (!(section.at < bounds.max[section.axis])) continue;
    csg::Node leaf{csg::Operation::Leaf, std::uint32_t(model_.leaves.size()), 0, 0};
    model_.leaves.push_back(boxLeaf(low, bounds.max));
    model_.childIndices.push_back(std::uint32_t(model_.nodes.size()));
    model_.nodes.push_back(leaf);
  }
  const auto childCount = std::uint32_t(model_.childIndices.size()) - firstChild;
  model_.root = std::uint32_t(model_.nodes.size());
  model_.nodes.push_back({csg::Operation::Difference, 0, firstChild, childCount});
}

bool CsgOracle::inside(int winding) const {
  switch (options_.inside) {
    case csg::InsideRule::NonZero: return winding != 0;
    case csg::InsideRule::Positive: return winding > 0;
    case csg::InsideRule::Odd: return winding % 2 != 0;
  }
  return false;
}

// The node changes as its children do; the subtracted ones count turned inside out. Of the children that change the same way as the node, the
// last one's face shows.
CsgOracle::NodeState CsgOracle::combine(const csg::Node& node, const std::vector<NodeState>& states) const {
  const bool isUnion = node.operation == csg::Operation::Union;
  const auto child = [&](std::uint32_t i) {
    NodeState s = states[model_.childIndices[node.firstChild + i]];
    if (node.operation == csg::Operation::Difference && i > 0) s = {!s.before, !s.after, s.face};
    return s;
  };

  NodeState result;
  if (node.childCount == 0) return result;
  result.before = result.after = !isUnion;
  for (std::uint32_t i = 0; i < node.childCount; ++i) {
    const NodeState s = child(i);
    result.before = isUnion ? result.before || s.before : result.before && s.before;
    result.after = isUnion ? result.after || s.after : result.after && s.after;
  }
  for (std::uint32_t i = 0; i < node.childCount; ++i)
    if (const NodeState s = child(i); s.before == result.before && s.after == result.after) result.face = s.face;
  return result;
}

CsgOracle::NodeState CsgOracle::evaluate(const std::vector<int>& before, const std::vector<int>& after) const {
  std::vector<NodeState> states(model_.nodes.size());
  for (std::size_t n = 0; n < model_.nodes.size(); ++n) {
    const csg::Node& node = model_.nodes[n];
    if (node.operation == csg::Operation::Leaf)
      states[n] = {inside(before[node.leaf]), inside(after[node.leaf]), node.leaf};
    else
      states[n] = combine(node, states);
  }
  return states[model_.root];
}

std::vector<int> CsgOracle::windingAtStart(const std::vector<Crossing>& crossings) const {
  // Behind everything a closed leaf's winding number is zero.
  std::vector<int> winding = openWindingAtEye_;
  for (const Crossing& c : crossings)
    if (closed_[c.mesh]) winding[c.mesh] -= c.winding;
  return winding;
}

// Calls visit(state, group of crossings) at each depth where the solid changes, until it returns false.
template <class Visit>
void CsgOracle::walk(const Ray& ray, Visit visit) const {
  if (model_.root == csg::kNoNode) return;
  std::vector<Crossing> crossings = caster_->cross(ray);
  if (caster_->view().perspective) std::erase_if(crossings, [&](const Crossing& c) { return c.depth.value < kNearShare * diagonal_; });
  std::vector<int> before = windingAtStart(crossings);
  for (std::size_t first = 0, last; first < crossings.size(); first = last) {
    std::vector<int> after = before;
    for (last = first; last < crossings.size(); ++last) {
      if (last > first && !caster_->sameDepth(ray, crossings[first], crossings[last], tolerance_)) break;
      after[crossings[last].mesh] += crossings[last].winding;
    }
    if (const NodeState root = evaluate(before, after); root.before != root.after) {
      // Of the showing leaf's crossings in this group, any tells the plane.
      std::size_t shown = first;
      while (shown + 1 < last && crossings[shown].mesh != root.face) ++shown;
      const Seen seen{crossings[shown].depth.value, root.face, crossings[shown].triangle};
      if (!visit(seen, root.after)) return;
    }
    before = std::move(after);
  }
}

std::optional<Seen> CsgOracle::see(const Ray& ray) const {
  std::optional<Seen> found;
  walk(ray, [&](const Seen& seen, bool entering) {
    if (entering) found = seen;
    return !entering;
  });
  return found;
}

std::vector<CsgOracle::Change> CsgOracle::changes(const Ray& ray) const {
  std::vector<Change> all;
  walk(ray, [&](const Seen& seen, bool entering) {
    all.push_back({seen, entering});
    return true;
  });
  return all;
}

MeshOracle::MeshOracle(const OracleMesh& result, const View& view, double sceneDiagonal)
    : caster_({result}, view), diagonal_(sceneDiagonal) {}

std::optional<Seen> MeshOracle::see(const Ray& ray) const {
  // The result of a Boolean is closed and simple: inside is 1, outside is 0, and what lies in front of a ray tells where the eye is.
  std::vector<Crossing> crossings = caster_.cross(ray);
  int winding = 0;
  for (const Crossing& c : crossings) winding -= c.winding;
  for (std::size_t first = 0, last; first < crossings.size(); first = last) {
    const int before = winding;
    for (last = first; last < crossings.size(); ++last) {
      if (last > first && !caster_.sameDepth(ray, crossings[first], crossings[last], 0)) break;
      winding += crossings[last].winding;
    }
    if (before == 0 && winding != 0) return Seen{crossings[first].depth.value, 0, crossings[first].triangle};
  }
  return std::nullopt;
}

}  // namespace copeel::validation
