// Depth of each plane class as one affine function of the pixel, set up once per view in double.
//
// The order value s grows with distance along the ray: s = -1/t in perspective (t the distance along the view axis), s = t
// orthographically; both are affine in the pixel. All fragments of a class at a pixel have the same s to the bit. Every class carries a
// bound of the error of its s against the true plane (the three vertices of its representative, as doubles), so that an order is
// certain when two values differ by more than the sum of their bounds. 32 bytes a class, half a line of the cache: tiles read them far and wide.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "core/coplanarity/plane_classes.h"
#include "core/scene/view.h"
#include "core/uninitialized.h"

namespace copeel {

struct DepthPlane {
  // Of an error bound: a power of two, from 2^-kErrorBias on; the last exponent of eight bits stands for +inf.
  static constexpr std::uint32_t kErrorBits = 4, kErrorMask = (1u << kErrorBits) - 1, kUnknown = (1u << 2 * kErrorBits) - 1, kErrorBias = 180;

  double a, b, c;   // s = a·u + b·v + c, with u, v of view.h
  // Range of the class's faces, up to 1e38: beyond a silhouette s is held to it. The lowest four bits of each hold half of the error's exponent, and whatever
  // they are, no face lies beyond.
  float lo, hi;

  // Bound of |s - true s| within the image; +inf where the plane holds the eye.
  double error() const {
    const std::uint32_t exponent = (std::bit_cast<std::uint32_t>(lo) & kErrorMask) << kErrorBits | (std::bit_cast<std::uint32_t>(hi) & kErrorMask);
    if (exponent == kUnknown) return std::numeric_limits<double>::infinity();
    return std::bit_cast<double>(std::uint64_t{exponent + 1023 - kErrorBias} << 52);
  }
};
static_assert(sizeof(DepthPlane) == 32);

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
