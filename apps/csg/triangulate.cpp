// Legend: a triangle holds its corners v counter-clockwise and its neighbours n, n[i] across the edge opposite v[i]; cut[i] counts the
// loops that run along that edge. Points are visited in a shuffled order, each found by a walk from the last one.
#include "apps/csg/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace copeel::csg {
namespace {

using Index = std::uint32_t;
constexpr Index kNone = ~Index{0};

// (3 + 16 ε) ε: the bound of Shewchuk's first filter for a 2 × 2 determinant of differences.
constexpr double kOrientationBound = 3.3306690738754716e-16;

double orientationExact(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  using Wide = __float128;
  const Wide determinant = (Wide(a.x) - c.x) * (Wide(b.y) - c.y) - (Wide(a.y) - c.y) * (Wide(b.x) - c.x);
  return determinant > 0 ? 1.0 : determinant < 0 ? -1.0 : 0.0;
}

struct Triangle {
  std::array<Index, 3> v;
  std::array<Index, 3> n;
  std::array<Index, 3> cut;
};

constexpr std::array<int, 3> kNext{1, 2, 0};
constexpr std::array<int, 3> kPrevious{2, 0, 1};

class Triangulation {
 public:
  explicit Triangulation(std::vector<glm::dvec2> points) : points_(std::move(points)) {
    count_ = static_cast<Index>(points_.size());
    addFrame();
  }

  void insertAll() {
    std::vector<Index> order(count_);
    std::iota(order.begin(), order.end(), 0u);
    // A fixed shuffle: in their own order, the corners of a circle would be the worst case.
    std::uint64_t state = 0x9E3779B97F4A7C15u;
    for (Index i = count_; i > 1; --i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      std::swap(order[i - 1], order[(state >> 33) % i]);
    }
    for (const Index p : order) insert(p);
  }

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
    for (Index t = 0; t < triangles_.size(); ++t) {
      for (int i = 0; i < 3; ++i) pending.emplace_back(t, i);
    }
    std::size_t flipsLeft = 4 * triangles_.size() + 100;
    while (!pending.empty() && flipsLeft > 0) {
      const auto [t, i] = pending.back();
      pending.pop_back();
      if (!wantsFlip(t, i)) continue;
      const Index u = triangles_[t].n[static_cast<std::size_t>(i)];
      flip(t, i);
      --flipsLeft;
      for (const Index changed : {t, u}) {
        for (int k = 0; k < 3; ++k) pending.emplace_back(changed, k);
      }
    }
  }

  std::vector<glm::uvec3> inside() const {
    std::vector<std::int8_t> parity(triangles_.size(), -1);
    std::vector<Index> pending;
    const Index start = triangleOf_[count_];
    parity[start] = 0;
    pending.push_back(start);
    std::vector<glm::uvec3> result;
    while (!pending.empty()) {
      const Index t = pending.back();
      pending.pop_back();
      const Triangle& triangle = triangles_[t];
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
  // One large triangle around all; its corners come after the points.
  void addFrame() {
    glm::dvec2 low = points_.front(), high = points_.front();
    for (const glm::dvec2& p : points_) {
      low = glm::dvec2(std::min(low.x, p.x), std::min(low.y, p.y));
      high = glm::dvec2(std::max(high.x, p.x), std::max(high.y, p.y));
    }
    const glm::dvec2 center = (low + high) * 0.5;
    const double size = std::max({high.x - low.x, high.y - low.y, 1e-300}) * 16;
    points_.emplace_back(center.x - 2 * size, center.y - size);
    points_.emplace_back(center.x + 2 * size, center.y - size);
    points_.emplace_back(center.x, center.y + 2 * size);
    triangleOf_.assign(points_.size(), kNone);
    addTriangle({{count_, count_ + 1, count_ + 2}, {kNone, kNone, kNone}, {0, 0, 0}});
  }

  Index addTriangle(const Triangle& triangle) {
    triangles_.push_back(triangle);
    const auto t = static_cast<Index>(triangles_.size() - 1);
    own(t);
    return t;
  }

  void own(Index t) {
    for (const Index v : triangles_[t].v) triangleOf_[v] = t;
  }

  double turn(Index a, Index b, Index c) const { return orientation(points_[a], points_[b], points_[c]); }

  void relink(Index t, Index from, Index to) {
    if (t == kNone) return;
    for (Index& n : triangles_[t].n) {
      if (n == from) {
        n = to;
        return;
      }
    }
  }

  int indexOf(Index t, Index vertex) const {
    const Triangle& triangle = triangles_[t];
    return triangle.v[0] == vertex ? 0 : triangle.v[1] == vertex ? 1 : 2;
  }

  int edgeTo(Index t, Index neighbour) const {
    const Triangle& triangle = triangles_[t];
    return triangle.n[0] == neighbour ? 0 : triangle.n[1] == neighbour ? 1 : 2;
  }

  // The triangle that holds the point, on its border perhaps.
  Index locate(Index p) {
    Index t = last_;
    for (std::size_t steps = 0; steps < 4 * triangles_.size() + 16; ++steps) {
      int across = -1;
      for (int k = 0; k < 3 && across < 0; ++k) {
        // The first edge tried changes from step to step, so that no walk goes round in a ring.
        const int i = static_cast<int>((steps + static_cast<std::size_t>(k)) % 3);
        const Triangle& triangle = triangles_[t];
        if (turn(triangle.v[static_cast<std::size_t>(kNext[i])], triangle.v[static_cast<std::size_t>(kPrevious[i])], p) < 0) across = i;
      }
      if (across < 0) return t;
      t = triangles_[t].n[static_cast<std::size_t>(across)];
    }
    return t;
  }

  void insert(Index p) {
    const Index t = locate(p);
    last_ = t;
    int onEdge = -1;
    for (int i = 0; i < 3; ++i) {
      const Triangle& triangle = triangles_[t];
      if (turn(triangle.v[static_cast<std::size_t>(kNext[i])], triangle.v[static_cast<std::size_t>(kPrevious[i])], p) == 0) onEdge = i;
    }
    if (onEdge < 0) {
      splitTriangle(t, p);
    } else {
      splitEdge(t, onEdge, p);
    }
    legalize(p);
  }

  void splitTriangle(Index t, Index p) {
    const Triangle old = triangles_[t];
    const auto first = static_cast<Index>(triangles_.size());
    const Index parts[3] = {t, first, first + 1};
    triangles_.resize(triangles_.size() + 2);
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      const Index next = parts[kNext[i]], previous = parts[kPrevious[i]];
      triangles_[parts[i]] = {{p, old.v[static_cast<std::size_t>(kNext[i])], old.v[static_cast<std::size_t>(kPrevious[i])]},
                              {old.n[k], next, previous}, {old.cut[k], 0, 0}};
      relink(old.n[k], t, parts[i]);
      own(parts[i]);
      suspects_.push_back(parts[i]);
    }
  }

  // p lies on the edge of t opposite its corner i.
  void splitEdge(Index t, int i, Index p) {
    const Index u = triangles_[t].n[static_cast<std::size_t>(i)];
    const int j = edgeTo(u, t);
    const Triangle oldT = triangles_[t], oldU = triangles_[u];
    const auto at = [](const auto& array, int k) { return array[static_cast<std::size_t>(k)]; };
    const Index a = at(oldT.v, i), b = at(oldT.v, kNext[i]), c = at(oldT.v, kPrevious[i]), d = at(oldU.v, j);
    const Index cut = at(oldT.cut, i);
    const auto t2 = static_cast<Index>(triangles_.size());
    const Index u2 = t2 + 1;
    triangles_.resize(triangles_.size() + 2);
    // Before: t = (a, b, c), u = (d, c, b). After: t = (p, a, b), t2 = (p, c, a), u = (p, d, c), u2 = (p, b, d).
    triangles_[t] = {{p, a, b}, {at(oldT.n, kPrevious[i]), u2, t2}, {at(oldT.cut, kPrevious[i]), cut, 0}};
    triangles_[t2] = {{p, c, a}, {at(oldT.n, kNext[i]), t, u}, {at(oldT.cut, kNext[i]), 0, cut}};
    triangles_[u] = {{p, d, c}, {at(oldU.n, kPrevious[j]), t2, u2}, {at(oldU.cut, kPrevious[j]), cut, 0}};
    triangles_[u2] = {{p, b, d}, {at(oldU.n, kNext[j]), u, t}, {at(oldU.cut, kNext[j]), 0, cut}};
    relink(at(oldT.n, kNext[i]), t, t2);
    relink(at(oldU.n, kNext[j]), u, u2);
    for (const Index part : {t, t2, u, u2}) {
      own(part);
      suspects_.push_back(part);
    }
  }

  // Flips the edges that face p until all of them are Delaunay; each flip gives p one more edge, so it ends.
  void legalize(Index p) {
    while (!suspects_.empty()) {
      const Index t = suspects_.back();
      suspects_.pop_back();
      const int i = indexOf(t, p);
      if (!wantsFlip(t, i)) continue;
      const Index u = triangles_[t].n[static_cast<std::size_t>(i)];
      flip(t, i);
      suspects_.push_back(t);
      suspects_.push_back(u);
    }
  }

  bool wantsFlip(Index t, int i) const {
    const auto k = static_cast<std::size_t>(i);
    const Triangle& triangle = triangles_[t];
    const Index u = triangle.n[k];
    if (u == kNone || triangle.cut[k] != 0) return false;
    const Index far = triangles_[u].v[static_cast<std::size_t>(edgeTo(u, t))];
    return inCircle(points_[triangle.v[0]], points_[triangle.v[1]], points_[triangle.v[2]], points_[far]) > 0 && isConvexAcross(t, i);
  }

  // The two triangles along the edge form a quad with four true left turns.
  bool isConvexAcross(Index t, int i) const {
    const Triangle& triangle = triangles_[t];
    const Index u = triangle.n[static_cast<std::size_t>(i)];
    const Index far = triangles_[u].v[static_cast<std::size_t>(edgeTo(u, t))];
    const Index near = triangle.v[static_cast<std::size_t>(i)];
    const Index b = triangle.v[static_cast<std::size_t>(kNext[i])], c = triangle.v[static_cast<std::size_t>(kPrevious[i])];
    return turn(near, b, far) > 0 && turn(near, far, c) > 0;
  }

  // t = (a, b, c) and u = (d, c, b) become t = (a, b, d) and u = (a, d, c).
  void flip(Index t, int i) {
    const Index u = triangles_[t].n[static_cast<std::size_t>(i)];
    const int j = edgeTo(u, t);
    const Triangle oldT = triangles_[t], oldU = triangles_[u];
    const auto at = [](const auto& array, int k) { return array[static_cast<std::size_t>(k)]; };
    const Index a = at(oldT.v, i), b = at(oldT.v, kNext[i]), c = at(oldT.v, kPrevious[i]), d = at(oldU.v, j);
    triangles_[t] = {{a, b, d}, {at(oldU.n, kNext[j]), u, at(oldT.n, kPrevious[i])}, {at(oldU.cut, kNext[j]), 0, at(oldT.cut, kPrevious[i])}};
    triangles_[u] = {{a, d, c}, {at(oldU.n, kPrevious[j]), at(oldT.n, kNext[i]), t}, {at(oldU.cut, kPrevious[j]), at(oldT.cut, kNext[i]), 0}};
    relink(at(oldU.n, kNext[j]), u, t);
    relink(at(oldT.n, kNext[i]), t, u);
    own(t);
    own(u);
  }

  // Calls visit(triangle, index of the vertex in it) around a vertex until it returns true.
  template <class Visit>
  bool around(Index vertex, Visit visit) const {
    const Index start = triangleOf_[vertex];
    Index t = start;
    do {
      const int i = indexOf(t, vertex);
      if (visit(t, i)) return true;
      t = triangles_[t].n[static_cast<std::size_t>(kNext[i])];
    } while (t != start && t != kNone);
    return false;
  }

  void mark(Index t, int i) {
    const Index u = triangles_[t].n[static_cast<std::size_t>(i)];
    ++triangles_[t].cut[static_cast<std::size_t>(i)];
    if (u != kNone) ++triangles_[u].cut[static_cast<std::size_t>(edgeTo(u, t))];
  }

  // True where the edge a-b stands; marks it.
  bool markEdge(Index a, Index b) {
    Index found = kNone;
    int edge = 0;
    around(a, [&](Index t, int i) {
      const Triangle& triangle = triangles_[t];
      if (triangle.v[static_cast<std::size_t>(kNext[i])] == b) edge = kPrevious[i];
      else if (triangle.v[static_cast<std::size_t>(kPrevious[i])] == b) edge = kNext[i];
      else return false;
      found = t;
      return true;
    });
    if (found == kNone) return false;
    mark(found, edge);
    return true;
  }

  // Makes the first part of a-b an edge, up to the first point on it; returns that point.
  Index constrainPart(Index a, Index b) {
    if (markEdge(a, b)) return b;
    Index t = kNone, onLine = kNone, right = kNone, left = kNone;
    around(a, [&](Index s, int i) {
      const Index v = triangles_[s].v[static_cast<std::size_t>(kNext[i])], w = triangles_[s].v[static_cast<std::size_t>(kPrevious[i])];
      const double atV = turn(a, b, v), atW = turn(a, b, w);
      const glm::dvec2 along = points_[b] - points_[a], toV = points_[v] - points_[a];
      if (atV == 0 && along.x * toV.x + along.y * toV.y > 0) onLine = v;
      else if (atV < 0 && atW > 0 && turn(v, w, a) > 0 && turn(v, w, b) < 0) t = s, right = v, left = w;
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
      if (triangles_[t].cut[static_cast<std::size_t>(i)] != 0) return kNone;
      crossed.emplace_back(right, left);
      const Index u = triangles_[t].n[static_cast<std::size_t>(i)];
      const Index far = triangles_[u].v[static_cast<std::size_t>(edgeTo(u, t))];
      t = u;
      const double side = far == b ? 0 : turn(a, b, far);
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
      around(v, [&](Index s, int i) {
        if (triangles_[s].v[static_cast<std::size_t>(kNext[i])] != w) return false;
        t = s;
        edge = kPrevious[i];
        return true;
      });
      if (t == kNone) return false;
      if (!isConvexAcross(t, edge)) {
        crossed.emplace_back(v, w);
        continue;
      }
      const Index u = triangles_[t].n[static_cast<std::size_t>(edge)];
      const Index near = triangles_[t].v[static_cast<std::size_t>(edge)], far = triangles_[u].v[static_cast<std::size_t>(edgeTo(u, t))];
      flip(t, edge);
      const bool touches = near == a || near == b || far == a || far == b;
      if (!touches && turn(a, b, near) * turn(a, b, far) < 0) crossed.emplace_back(near, far);
    }
    return true;
  }

  int edgeBetween(Index t, Index v, Index w) const {
    const Triangle& triangle = triangles_[t];
    for (int i = 0; i < 3; ++i) {
      const Index corner = triangle.v[static_cast<std::size_t>(i)];
      if (corner != v && corner != w) return i;
    }
    return 0;
  }

  std::vector<glm::dvec2> points_;
  Index count_ = 0;                    // points without the frame
  std::vector<Triangle> triangles_;
  std::vector<Index> triangleOf_;      // any triangle at a point
  std::vector<Index> suspects_;
  Index last_ = 0;
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

}  // namespace

double orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  const double left = (a.x - c.x) * (b.y - c.y);
  const double right = (a.y - c.y) * (b.x - c.x);
  const double determinant = left - right;
  if (std::abs(determinant) > kOrientationBound * (std::abs(left) + std::abs(right))) return determinant;
  return orientationExact(a, b, c);
}

// Not exact: it chooses shapes, not topology.
double inCircle(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c, const glm::dvec2& d) {
  const glm::dvec2 p = a - d, q = b - d, r = c - d;
  const auto square = [](const glm::dvec2& v) { return v.x * v.x + v.y * v.y; };
  const double first = square(p) * (q.x * r.y - q.y * r.x);
  const double second = square(q) * (r.x * p.y - r.y * p.x);
  const double third = square(r) * (p.x * q.y - p.y * q.x);
  const double sum = first + second + third;
  // What rounding may have made counts as on the circle, so that a flip is never undone.
  return std::abs(sum) > 1e-14 * (std::abs(first) + std::abs(second) + std::abs(third)) ? sum : 0.0;
}

std::optional<std::vector<glm::uvec3>> triangulate(std::span<const glm::dvec2> points, std::span<const std::uint32_t> loopEnds) {
  if (points.size() < 3) return std::vector<glm::uvec3>{};
  const std::vector<Index> first = firstAtPosition(points);
  std::vector<Index> compact(points.size(), kNone), original;
  std::vector<glm::dvec2> distinct;
  for (Index i = 0; i < points.size(); ++i) {
    if (first[i] != i) continue;
    compact[i] = static_cast<Index>(distinct.size());
    distinct.push_back(points[i]);
    original.push_back(i);
  }
  Triangulation triangulation(std::move(distinct));
  triangulation.insertAll();
  std::size_t begin = 0;
  for (const std::uint32_t end : loopEnds) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t next = i + 1 < end ? i + 1 : begin;
      if (!triangulation.constrain(compact[first[i]], compact[first[next]])) return std::nullopt;
    }
    begin = end;
  }
  triangulation.improve();
  std::vector<glm::uvec3> triangles = triangulation.inside();
  for (glm::uvec3& t : triangles) t = {original[t.x], original[t.y], original[t.z]};
  return triangles;
}

bool isConvexLoop(std::span<const glm::dvec2> points) {
  const std::size_t n = points.size();
  if (n < 3) return false;
  // Once around means that the direction turns from rising to falling in x once only.
  std::size_t changes = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 &a = points[i], &b = points[(i + 1) % n], &c = points[(i + 2) % n];
    if (!(orientation(a, b, c) > 0)) return false;
    if ((a.x < b.x || (a.x == b.x && a.y < b.y)) != (b.x < c.x || (b.x == c.x && b.y < c.y))) ++changes;
  }
  return changes == 2;
}

}  // namespace copeel::csg
