// How order values (core/coplanarity/depth_planes.h) become depth keys in a view: what fragment.glsl computes, and the same on the host.
#pragma once

#include <cstdint>
#include <vector>

#include "core/coplanarity/depth_planes.h"

namespace copeel::gl {

struct DepthScale {
  double origin = 0;
  std::uint64_t nearest = 0;   // bits of the nearest value
  int shift = 31, sign = 1;
  std::uint32_t keys = 1;      // that are in use
};

DepthScale depthScale(const DepthPlanes& depths, bool perspective);

// The key of an order value that lies in the range of the view's planes; it never falls where the value grows.
std::uint32_t keyOf(const DepthScale& scale, double orderValue);

}  // namespace copeel::gl
