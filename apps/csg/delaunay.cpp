// Points are visited in a shuffled order, each found by a walk from the last one; flips around it bring Delaunay's rule back.
#include "apps/csg/delaunay.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace copeel::csg {
namespace {

constexpr double kLeastExtent = 0x1p-50;   // of the frame, relative to the coordinates: 8 ulp

}  // namespace

Delaunay::Delaunay(std::vector<glm::dvec2> points) : points_(std::move(points)), count_(static_cast<Index>(points_.size())) {
  addFrame();
  insertAll();
}

void Delaunay::insertAll() {
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

// One large triangle around all; its corners come after the points.
void Delaunay::addFrame() {
  glm::dvec2 low = points_.front(), high = points_.front();
  for (const glm::dvec2& p : points_) {
    low = glm::dvec2(std::min(low.x, p.x), std::min(low.y, p.y));
    high = glm::dvec2(std::max(high.x, p.x), std::max(high.y, p.y));
  }
  const glm::dvec2 center = (low + high) * 0.5;
  // Points on a line parallel to an axis may have no extent that the frame's corners could show beside the coordinates.
  const double largest = std::max({std::abs(low.x), std::abs(low.y), std::abs(high.x), std::abs(high.y), 1e-300});
  const double size = std::max({high.x - low.x, high.y - low.y, largest * kLeastExtent}) * 16;
  points_.emplace_back(center.x - 2 * size, center.y - size);
  points_.emplace_back(center.x + 2 * size, center.y - size);
  points_.emplace_back(center.x, center.y + 2 * size);
  triangleOf_.assign(points_.size(), kNone);
  addTriangle({{count_, count_ + 1, count_ + 2}, {kNone, kNone, kNone}, {0, 0, 0}});
}

Delaunay::Index Delaunay::addTriangle(const Triangle& triangle) {
  triangles_.push_back(triangle);
  const auto t = static_cast<Index>(triangles_.size() - 1);
  own(t);
  return t;
}

void Delaunay::own(Index t) {
  for (const Index v : triangles_[t].v) triangleOf_[v] = t;
}

void Delaunay::relink(Index t, Index from, Index to) {
  if (t == kNone) return;
  for (Index& n : triangles_[t].n) {
    if (n == from) {
      n = to;
      return;
    }
  }
}

// The triangle that holds the point, on its border perhaps.
Delaunay::Index Delaunay::locate(Index p) {
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

void Delaunay::insert(Index p) {
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

void Delaunay::splitTriangle(Index t, Index p) {
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
void Delaunay::splitEdge(Index t, int i, Index p) {
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
void Delaunay::legalize(Index p) {
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

bool Delaunay::wantsFlip(Index t, int i) const {
  const auto k = static_cast<std::size_t>(i);
  const Triangle& triangle = triangles_[t];
  const Index u = triangle.n[k];
  if (u == kNone || triangle.cut[k] != 0) return false;
  const Index far = triangles_[u].v[static_cast<std::size_t>(edgeTo(u, t))];
  return inCircle(points_[triangle.v[0]], points_[triangle.v[1]], points_[triangle.v[2]], points_[far]) > 0 && isConvexAcross(t, i);
}

bool Delaunay::isConvexAcross(Index t, int i) const {
  const Triangle& triangle = triangles_[t];
  const Index u = triangle.n[static_cast<std::size_t>(i)];
  const Index far = triangles_[u].v[static_cast<std::size_t>(edgeTo(u, t))];
  const Index near = triangle.v[static_cast<std::size_t>(i)];
  const Index b = triangle.v[static_cast<std::size_t>(kNext[i])], c = triangle.v[static_cast<std::size_t>(kPrevious[i])];
  return turn(near, b, far) > 0 && turn(near, far, c) > 0;
}

// t = (a, b, c) and u = (d, c, b) become t = (a, b, d) and u = (a, d, c).
void Delaunay::flip(Index t, int i) {
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

void Delaunay::mark(Index t, int i) {
  const Index u = triangles_[t].n[static_cast<std::size_t>(i)];
  ++triangles_[t].cut[static_cast<std::size_t>(i)];
  if (u != kNone) ++triangles_[u].cut[static_cast<std::size_t>(edgeTo(u, t))];
}

}  // namespace copeel::csg
