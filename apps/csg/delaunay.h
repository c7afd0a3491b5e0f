// A Delaunay triangulation of points in the plane, built by insertion and flips, whose edges may be marked as parts of loops.
//
// Based on: Lawson. Software for C1 surface interpolation. Mathematical Software III, 1977.
// Legend: a triangle holds its corners v counter-clockwise and its neighbours n, n[i] across the edge opposite v[i]; cut[i] counts the
// loops that run along that edge. Cost: O(n^1.5) at worst in practice; 36 bytes a triangle; no recursion.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/vec2.hpp>

#include "apps/csg/orientation.h"

namespace copeel::csg {

class Delaunay {
 public:
  using Index = std::uint32_t;
  static constexpr Index kNone = ~Index{0};
  static constexpr std::array<int, 3> kNext{1, 2, 0};
  static constexpr std::array<int, 3> kPrevious{2, 0, 1};

  static constexpr double kLargest = 0x1p1000;   // a frame around it still fits a double

  struct Triangle {
    std::array<Index, 3> v;
    std::array<Index, 3> n;
    std::array<Index, 3> cut;
  };

  // Distinct points, none beyond kLargest; the corners of a frame around them come after them.
  explicit Delaunay(std::vector<glm::dvec2> points);

  const std::vector<Triangle>& triangles() const { return triangles_; }
  const Triangle& triangle(Index t) const { return triangles_[t]; }
  const glm::dvec2& point(Index p) const { return points_[p]; }
  Index outerTriangle() const { return triangleOf_[count_]; }   // one at the frame

  double turn(Index a, Index b, Index c) const { return orientation(points_[a], points_[b], points_[c]); }
  int edgeTo(Index t, Index neighbour) const {
    const Triangle& triangle = triangles_[t];
    return triangle.n[0] == neighbour ? 0 : triangle.n[1] == neighbour ? 1 : 2;
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

  // An unmarked edge whose flip makes its two triangles better shaped, and is possible.
  bool wantsFlip(Index t, int i) const;
  // The two triangles along the edge form a quad with four true left turns.
  bool isConvexAcross(Index t, int i) const;
  void flip(Index t, int i);
  void mark(Index t, int i);   // one more loop along the edge

 private:
  void addFrame();
  void insertAll();
  Index addTriangle(const Triangle& triangle);
  void own(Index t);
  void relink(Index t, Index from, Index to);
  int indexOf(Index t, Index vertex) const {
    const Triangle& triangle = triangles_[t];
    return triangle.v[0] == vertex ? 0 : triangle.v[1] == vertex ? 1 : 2;
  }
  Index locate(Index p);
  void insert(Index p);
  void splitTriangle(Index t, Index p);
  void splitEdge(Index t, int i, Index p);
  void legalize(Index p);

  std::vector<glm::dvec2> points_;
  Index count_;                        // points without the frame
  std::vector<Triangle> triangles_;
  std::vector<Index> triangleOf_;      // any triangle at a point
  std::vector<Index> suspects_;
  Index last_ = 0;
};

}  // namespace copeel::csg
