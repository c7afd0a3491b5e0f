// The order of two plane classes at a pixel, decided exactly: the rare path behind the error bounds of depth_planes.h.
//
// The true plane of a class is spanned by the three world vertices of its representative; the true ray is that of the view's doubles. Both
// are rationals, and so is the order value; it is held to the class's range exactly as its approximation is. About 10 µs a decision.
// Based on: Yap, Towards exact geometric computation. Computational Geometry 7, 1997 (filtered predicates).
#pragma once

#include <vector>

#include "core/coplanarity/depth_planes.h"

namespace copeel {

class ExactOrder {
 public:
  ExactOrder(const Scene& scene, const PlaneClasses& planes, const DepthPlanes& depths, const View& view)
      : scene_(scene), planes_(planes), depths_(depths), view_(view) {}

  // -1, 0, +1: class p is nearer than, level with or farther than class q at the sample of pixel (x, y).
  int compare(std::uint32_t p, std::uint32_t q, int x, int y) const;

 private:
  const Scene& scene_;
  const PlaneClasses& planes_;
  const DepthPlanes& depths_;
  const View& view_;
};

}  // namespace copeel
