#include "core/gl/depth_keys.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "core/gl/layout.h"

namespace copeel::gl {

DepthScale depthScale(const DepthPlanes& depths, bool perspective) {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (const DepthPlane& plane : depths) {
    least = std::min(least, double(plane.lo));
    most = std::max(most, double(plane.hi));
  }
  DepthScale scale;
  scale.sign = perspective ? -1 : 1;
  if (!(least <= most)) return scale;
  double low = perspective ? -most : least, high = perspective ? -least : most;
  // Less than one octave holds the values (2.25 to 1.25 of their extent), or as many as they need: from there on keys are relative.
  const double extent = std::max(high - low, std::max(std::abs(low), std::abs(high)) * 0x1p-40);
  scale.origin = perspective && low < 1.25 * extent ? 0 : low - 1.25 * extent;
  low -= scale.origin, high -= scale.origin;
  const std::uint64_t lowBits = std::bit_cast<std::uint64_t>(low), highBits = std::bit_cast<std::uint64_t>(high);
  scale.nearest = perspective ? highBits : lowBits;
  scale.shift = 1;
  while (((highBits - lowBits) >> scale.shift) >= COPEEL_KEY_NONE - COPEEL_KEY_LEAST) ++scale.shift;
  scale.keys = static_cast<std::uint32_t>((highBits - lowBits) >> scale.shift) + 1;
  return scale;
}

std::uint32_t keyOf(const DepthScale& scale, double orderValue) {
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(double(scale.sign) * orderValue - scale.origin);
  return COPEEL_KEY_LEAST + static_cast<std::uint32_t>((scale.sign > 0 ? bits - scale.nearest : scale.nearest - bits) >> scale.shift);
}

}  // namespace copeel::gl
