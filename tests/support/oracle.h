// An independent answer, pixel by pixel: every triangle met by the ray in 3D, in long double, and the tree evaluated by recursion.
// Knows nothing of tiles, snapping, plane classes, keys or gates. Slow; for images of some thousand pixels.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "apps/csg/render_csg.h"
#include "core/scene/scene.h"
#include "core/scene/view.h"

namespace copeel::test {

using Real = long double;
using Vec = glm::vec<3, Real>;

struct OraclePixel {
  bool edge = false;      // the sample lies within a sub-pixel step of a projected edge, or two planes all but cross there
  std::uint32_t id = 0;   // 1 + leaf
  Real depth = std::numeric_limits<Real>::infinity();
};

class Oracle {
 public:
  Oracle(const csg::Model& model, const View& view, csg::InsideRule rule = csg::InsideRule::NonZero)
      : model_(model), view_(view), rule_(rule) {
    for (std::uint32_t i = 0; i < model.leaves.size(); ++i) {
      const csg::Leaf& leaf = model.leaves[i];
      const Real mirror = glm::determinant(glm::dmat3(leaf.worldFromObject)) < 0 ? -1 : 1;
      for (const glm::uvec3& t : leaf.mesh->triangles) {
        Triangle triangle{i, mirror, {}};
        for (int k = 0; k < 3; ++k) triangle.p[k] = Vec(transformPoint(leaf.worldFromObject, leaf.mesh->vertices[t[k]]));
        triangles_.push_back(triangle);
        for (const Vec& p : triangle.p) size_ = std::max(size_, glm::length(p - triangles_.front().p[0]));
      }
    }
  }

  OraclePixel pixel(int x, int y) const {
    OraclePixel result;
    std::vector<Hit> hits;
    const Real u = x + 0.5L - view_.width / 2.0L, v = y + 0.5L - view_.height / 2.0L;
    for (const Triangle& t : triangles_) meet(t, u, v, hits, result.edge);
    std::sort(hits.begin(), hits.end(), [](const Hit& a, const Hit& b) { return a.depth < b.depth; });
    std::vector<int> winding(model_.leaves.size(), 0);
    if (view_.perspective) winding = windingAt(Vec(view_.eye) + kStart * size_ * (Vec(view_.forward) + u * Vec(view_.right) + v * Vec(view_.down)));
    if (model_.root == csg::kNoNode) return result;
    for (std::size_t i = 0; i < hits.size();) {
      if (view_.perspective && hits[i].depth <= kStart * size_) {
        ++i;
        continue;
      }
      const std::vector<int> before = winding;
      const Real depth = hits[i].depth;
      for (; i < hits.size() && hits[i].depth - depth <= kSame * size_; ++i) winding[hits[i].leaf] += hits[i].side;
      // Planes that are neither level nor clearly apart make the pixel doubtful.
      if (i < hits.size() && hits[i].depth - depth < kApart * size_) result.edge = true;
      if (value(model_.root, before) || !value(model_.root, winding)) continue;
      result.depth = depth;
      result.id = 1 + shownLeaf(model_.root, before, winding);
      break;
    }
    return result;
  }

 private:
  struct Triangle {
    std::uint32_t leaf;
    Real mirror;
    Vec p[3];
  };
  struct Hit {
    Real depth;
    std::uint32_t leaf;
    int side;
  };
  static constexpr Real kSame = 1e-9L, kApart = 1e-6L, kStart = 1e-7L;   // of the model's size
  static constexpr Real kStepPx = 4e-4L;                  // a sub-pixel step and a half for images below 1,000 pixels

  void meet(const Triangle& t, Real u, Real v, std::vector<Hit>& hits, bool& edge) const {
    const Vec right(view_.right), down(view_.down), forward(view_.forward);
    const Vec origin = view_.perspective ? Vec(view_.eye) : Vec(view_.eye) + u * right + v * down;
    const Vec ray = view_.perspective ? forward + u * right + v * down : forward;
    Vec q[3];
    for (int k = 0; k < 3; ++k) q[k] = t.p[k] - origin;
    // A plane that holds the eye is a line in the image, and the faces beside it have that line as an edge.
    const Vec normal = glm::cross(q[1] - q[0], q[2] - q[0]);
    if (view_.perspective && std::abs(glm::dot(normal, q[0])) <= 1e-12L * size_ * glm::length(normal)) return;
    // Signed distances in pixels of the sample from the projected lines of the edges.
    Real distance[3];
    bool positive = true, negative = true;
    for (int k = 0; k < 3; ++k) {
      const Vec &a = q[k], &b = q[(k + 1) % 3];
      const Vec m = glm::cross(a, b);
      const Real gu = view_.perspective ? glm::dot(right, m) : glm::dot(forward, glm::cross(right, a - b));
      const Real gv = view_.perspective ? glm::dot(down, m) : glm::dot(forward, glm::cross(down, a - b));
      const Real gradient = std::sqrt(gu * gu + gv * gv), side = glm::dot(ray, m);
      distance[k] = gradient > 0 ? side / gradient : 0;
      positive &= distance[k] > -kStepPx, negative &= distance[k] < kStepPx;
    }
    if (!positive && !negative) return;
    for (Real d : distance) edge |= std::abs(d) <= kStepPx;
    const Real facing = glm::dot(normal, ray);
    if (facing == 0) return;
    const Real depth = glm::dot(normal, q[0]) / facing;
    hits.push_back({depth, t.leaf, (facing < 0) == (t.mirror > 0) ? 1 : -1});
  }

  // Windings of closed leaves at a point on no face: a ray in a direction of no significance leaves them all.
  std::vector<int> windingAt(const Vec& point) const {
    std::vector<int> winding(model_.leaves.size(), 0);
    const Vec ray(0.3141L, 0.2718L, 0.9103L);
    for (const Triangle& t : triangles_) {
      const Vec a = t.p[0] - point, b = t.p[1] - point, c = t.p[2] - point;
      const Real ab = glm::dot(ray, glm::cross(a, b)), bc = glm::dot(ray, glm::cross(b, c)), ca = glm::dot(ray, glm::cross(c, a));
      const bool through = (ab > 0 && bc > 0 && ca > 0) || (ab < 0 && bc < 0 && ca < 0);
      if (!through) continue;
      const Vec normal = glm::cross(b - a, c - a);
      const Real facing = glm::dot(normal, ray);
      if (glm::dot(normal, a) / facing > 0) winding[t.leaf] += (facing > 0) == (t.mirror > 0) ? 1 : -1;
    }
    return winding;
  }

  bool inside(int winding) const {
    if (rule_ == csg::InsideRule::NonZero) return winding != 0;
    return rule_ == csg::InsideRule::Positive ? winding > 0 : winding % 2 != 0;
  }

  bool value(std::uint32_t index, const std::vector<int>& winding) const {
    const csg::Node& node = model_.nodes[index];
    if (node.operation == csg::Operation::Leaf) return inside(winding[node.leaf]);
    if (node.childCount == 0) return false;
    const auto child = [&](std::uint32_t i) { return value(model_.childIndices[node.firstChild + i], winding); };
    bool result = child(0);
    for (std::uint32_t i = 1; i < node.childCount; ++i) {
      if (node.operation == csg::Operation::Union) result = child(i) || result;
      if (node.operation == csg::Operation::Intersection) result = child(i) && result;
      if (node.operation == csg::Operation::Difference) result = !child(i) && result;
    }
    return result;
  }

  // The last leaf whose change is passed on by every operation above it; the node is known to change.
  std::uint32_t shownLeaf(std::uint32_t index, const std::vector<int>& before, const std::vector<int>& after) const {
    const csg::Node& node = model_.nodes[index];
    if (node.operation == csg::Operation::Leaf) return node.leaf;
    std::uint32_t best = 0;
    const bool rises = value(index, after);
    for (std::uint32_t i = 0; i < node.childCount; ++i) {
      const std::uint32_t child = model_.childIndices[node.firstChild + i];
      const bool was = value(child, before), is = value(child, after);
      const bool negated = node.operation == csg::Operation::Difference && i > 0;
      if (was != is && (is != negated) == rises) best = std::max(best, shownLeaf(child, before, after));
    }
    return best;
  }

  const csg::Model& model_;
  View view_;
  csg::InsideRule rule_;
  std::vector<Triangle> triangles_;
  Real size_ = 0;
};

// What differs between a drawn frame (with depth and ids) and the oracle, off the edge pixels.
struct Difference {
  int wrongIds = 0, wrongDepths = 0, edgePixels = 0, covered = 0;
  int x = -1, y = -1;   // of the first wrong pixel
  friend std::ostream& operator<<(std::ostream& out, const Difference& d) {
    return out << d.wrongIds << " wrong ids, " << d.wrongDepths << " wrong depths, first at (" << d.x << ", " << d.y << "); " << d.edgePixels
               << " edge pixels, " << d.covered << " covered";
  }
  bool none() const { return wrongIds == 0 && wrongDepths == 0; }
};

inline Difference compare(const csg::Frame& frame, const Oracle& oracle, double relative = 1e-6) {
  Difference result;
  for (int y = 0; y < frame.depth.height; ++y) {
    for (int x = 0; x < frame.depth.width; ++x) {
      const OraclePixel truth = oracle.pixel(x, y);
      result.edgePixels += truth.edge;
      result.covered += truth.id != 0;
      if (truth.edge) continue;
      const bool wrongId = frame.ids.at(x, y) != truth.id;
      const double depth = frame.depth.at(x, y), expected = static_cast<double>(truth.depth);
      const bool wrongDepth = !(depth == expected || std::abs(depth - expected) <= relative * std::abs(expected));
      if ((wrongId || wrongDepth) && result.x < 0) result.x = x, result.y = y;
      result.wrongIds += wrongId;
      result.wrongDepths += wrongDepth;
    }
  }
  return result;
}

}  // namespace copeel::test
