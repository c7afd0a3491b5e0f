// Depth of each plane class as one affine function of the pixel, set up once per view in double.
//
// The order value s grows with distance along the ray: s = -1/t in perspective (t the distance along the view axis), s = t
// orthographically; both are affine in the pixel. All fragments of a class at a pixel have the same s to the bit. Every class carries a
// bound of the error of its s against the true plane (the three vertices of its representative, as doubles), so that an order is
// certain when two values differ by more than the sum of their bounds. 40 bytes a class.
#pragma once

#include <algorithm>

#include "core/coplanarity/plane_classes.h"
#include "core/scene/view.h"
#include "core/uninitialized.h"

namespace copeel {

struct DepthPlane {
  double a, b, c;   // s = a·u + b·v + c, with u, v of view.h
  float lo, hi;     // range of the class's faces: beyond a silhouette s is held to it
  float error;      // bound of |s - true s| within the image; +inf where the plane holds the eye
};

using DepthPlanes = UninitializedVector<DepthPlane>;   // per plane class

// Nearest distance along the axis that is drawn in perspective; what lies between the eye and it counts as passed.
double nearDistance(const Scene& scene, const View& view);

DepthPlanes depthPlanes(const Scene& scene, const PlaneClasses& planes, const View& view);

// Distance along the view axis from the order value.
inline double distanceOf(double s, const View& view) { return view.perspective ? -1.0 / s : s; }

// Distance along the view axis of a class at the sample of pixel (x, y).
inline double distanceAt(const DepthPlane& plane, const View& view, int x, int y) {
  const double u = x + 0.5 + view.offset.x - view.width * 0.5, v = y + 0.5 + view.offset.y - view.height * 0.5;
  return distanceOf(std::clamp(plane.a * u + (plane.b * v + plane.c), double(plane.lo), double(plane.hi)), view);
}

}  // namespace copeel
