// The loops become edges one after the other: what stands in an edge's way is flipped away (Sloan).
#include "apps/csg/triangulate.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "apps/csg/delaunay.h"

namespace copeel::csg {
namespace {

using Index = Delaunay::Index;
using Triangle = Delaunay::Triangle;
constexpr Index kNone = Delaunay::kNone;
constexpr auto kNext = Delaunay::kNext;
constexpr auto kPrevious = Delaunay::kPrevious;

class Constraints {
 public:
  explicit Constraints(Delaunay& mesh) : mesh_(mesh) {}

  // False: the edge crosses one that stands already.
  bool constrain(Index a, Index b) {
    while (a != b) {
      const Index reached = constrainPart(a, b);
      if (reached == kNone) return false;
      a = reached;
    }
    return true;
  }

  // Flips what constraining has left ill-shaped.
  void improve() {
    std::vector<std::pair<Index, int>> pending;
    for (Index t = 0; t < mesh_.triangles().size(); ++t) {
      for (int i = 0; i < 3; ++i) pending.emplace_back(t, i);
    }
    std::size_t flipsLeft = 4 * mesh_.triangles().size() + 100;
    while (!pending.empty() && flipsLeft > 0) {
      const auto [t, i] = pending.back();
      pending.pop_back();
      if (!mesh_.wantsFlip(t, i)) continue;
      const Index u = mesh_.triangle(t).n[static_cast<std::size_t>(i)];
      mesh_.flip(t, i);
      --flipsLeft;
      for (const Index changed : {t, u}) {
        for (int k = 0; k < 3; ++k) pending.emplace_back(changed, k);
      }
    }
  }

  std::vector<glm::uvec3> inside() const {
    std::vector<std::int8_t> parity(mesh_.triangles().size(), -1);
    std::vector<Index> pending;
    const Index start = mesh_.outerTriangle();
    parity[start] = 0;
    pending.push_back(start);
    std::vector<glm::uvec3> result;
    while (!pending.empty()) {
      const Index t = pending.back();
      pending.pop_back();
      const Triangle& triangle = mesh_.triangle(t);
      if (parity[t] == 1) result.emplace_back(triangle.v[0], triangle.v[1], triangle.v[2]);
      for (std::size_t i = 0; i < 3; ++i) {
        const Index u = triangle.n[i];
        if (u == kNone || parity[u] >= 0) continue;
        parity[u] = static_cast<std::int8_t>(parity[t] ^ static_cast<int>(triangle.cut[i] & 1));
        pending.push_back(u);
      }
    }
    return result;
  }

 private:
  // True where the edge a-b stands; marks it.
  bool markEdge(Index a, Index b) {
    Index found = kNone;
    int edge = 0;
    mesh_.around(a, [&](Index t, int i) {
      const Triangle& triangle = mesh_.triangle(t);
      if (triangle.v[static_cast<std::size_t>(kNext[i])] == b) edge = kPrevious[i];
      else if (triangle.v[static_cast<std::size_t>(kPrevious[i])] == b) edge = kNext[i];
      else return false;
      found = t;
      return true;
    });
    if (found == kNone) return false;
    mesh_.mark(found, edge);
    return true;
  }

  // Makes the first part of a-b an edge, up to the first point on it; returns that point.
  Index constrainPart(Index a, Index b) {
    if (markEdge(a, b)) return b;
    Index t = kNone, onLine = kNone, right = kNone, left = kNone;
    mesh_.around(a, [&](Index s, int i) {
      const Triangle& triangle = mesh_.triangle(s);
      const Index v = triangle.v[static_cast<std::size_t>(kNext[i])], w = triangle.v[static_cast<std::size_t>(kPrevious[i])];
      const double atV = mesh_.turn(a, b, v), atW = mesh_.turn(a, b, w);
      const glm::dvec2 along = mesh_.point(b) - mesh_.point(a), toV = mesh_.point(v) - mesh_.point(a);
      if (atV == 0 && along.x * toV.x + along.y * toV.y > 0) onLine = v;
      else if (atV < 0 && atW > 0 && mesh_.turn(v, w, a) > 0 && mesh_.turn(v, w, b) < 0) t = s, right = v, left = w;
      return onLine != kNone || t != kNone;
    });
    if (onLine != kNone) return markEdge(a, onLine) ? onLine : kNone;
    if (t == kNone) return kNone;
    return openCorridor(a, b, t, right, left);
  }

  // Gathers the edges that cross a-b and flips them away.
  Index openCorridor(Index a, Index b, Index t, Index right, Index left) {
    std::vector<std::pair<Index, Index>> crossed;
    Index end = b;
    for (;;) {
      const int i = edgeBetween(t, right, left);
      if (mesh_.triangle(t).cut[static_cast<std::size_t>(i)] != 0) return kNone;
      crossed.emplace_back(right, left);
      const Index u = mesh_.triangle(t).n[static_cast<std::size_t>(i)];
      const Index far = mesh_.triangle(u).v[static_cast<std::size_t>(mesh_.edgeTo(u, t))];
      t = u;
      const double side = far == b ? 0 : mesh_.turn(a, b, far);
      if (side == 0) {
        end = far;
        break;
      }
      (side > 0 ? left : right) = far;
    }
    return flipAway(a, end, crossed) && markEdge(a, end) ? end : kNone;
  }

  bool flipAway(Index a, Index b, std::vector<std::pair<Index, Index>>& crossed) {
    std::size_t tries = 64 * crossed.size() * crossed.size() + 1024;
    std::size_t head = 0;
    while (head < crossed.size()) {
      if (tries-- == 0) return false;
      const Index v = crossed[head].first, w = crossed[head].second;
      ++head;
      Index t = kNone;
      int edge = 0;
      mesh_.around(v, [&](Index s, int i) {
        if (mesh_.triangle(s).v[static_cast<std::size_t>(kNext[i])] != w) return false;
        t = s;
        edge = kPrevious[i];
        return true;
      });
      if (t == kNone) return false;
      if (!mesh_.isConvexAcross(t, edge)) {
        crossed.emplace_back(v, w);
        continue;
      }
      const Index u = mesh_.triangle(t).n[static_cast<std::size_t>(edge)];
      const Index near = mesh_.triangle(t).v[static_cast<std::size_t>(edge)];
      const Index far = mesh_.triangle(u).v[static_cast<std::size_t>(mesh_.edgeTo(u, t))];
      mesh_.flip(t, edge);
      const bool touches = near == a || near == b || far == a || far == b;
      if (!touches && mesh_.turn(a, b, near) * mesh_.turn(a, b, far) < 0) crossed.emplace_back(near, far);
    }
    return true;
  }

  int edgeBetween(Index t, Index v, Index w) const {
    const Triangle& triangle = mesh_.triangle(t);
    for (int i = 0; i < 3; ++i) {
      const Index corner = triangle.v[static_cast<std::size_t>(i)];
      if (corner != v && corner != w) return i;
    }
    return 0;
  }

  Delaunay& mesh_;
};

// Equal positions become one point, the first that has it.
std::vector<Index> firstAtPosition(std::span<const glm::dvec2> points) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto less = [&](Index a, Index b) {
    const glm::dvec2 &p = points[a], &q = points[b];
    return p.x != q.x ? p.x < q.x : p.y != q.y ? p.y < q.y : a < b;
  };
  std::sort(order.begin(), order.end(), less);
  std::vector<Index> result(points.size());
  Index first = kNone;
  for (const Index i : order) {
    if (first == kNone || points[i] != points[first]) first = i;
    result[i] = first;
  }
  return result;
}

bool exceedsFrame(const glm::dvec2& p) { return !(std::abs(p.x) <= Delaunay::kLargest && std::abs(p.y) <= Delaunay::kLargest); }

}  // namespace

std::optional<std::vector<glm::uvec3>> triangulate(std::span<const glm::dvec2> points, std::span<const std::uint32_t> loopEnds) {
  if (std::any_of(points.begin(), points.end(), exceedsFrame)) return std::nullopt;
  const std::vector<Index> first = firstAtPosition(points);
  std::vector<Index> compact(points.size(), kNone), original;
  std::vector<glm::dvec2> distinct;
  for (Index i = 0; i < points.size(); ++i) {
    if (first[i] != i) continue;
    compact[i] = static_cast<Index>(distinct.size());
    distinct.push_back(points[i]);
    original.push_back(i);
  }
  if (distinct.size() < 3) return std::vector<glm::uvec3>{};
  Delaunay mesh(std::move(distinct));
  Constraints constraints(mesh);
  std::size_t begin = 0;
  for (const std::uint32_t end : loopEnds) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t next = i + 1 < end ? i + 1 : begin;
      if (!constraints.constrain(compact[first[i]], compact[first[next]])) return std::nullopt;
    }
    begin = end;
  }
  constraints.improve();
  std::vector<glm::uvec3> triangles = constraints.inside();
  for (glm::uvec3& t : triangles) t = {original[t.x], original[t.y], original[t.z]};
  return triangles;
}
}  // namespace copeel::csg
