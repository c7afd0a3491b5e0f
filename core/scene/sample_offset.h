// Where the samples of a pixel lie, for anti-aliasing.
#pragma once

#include <cmath>

#include <glm/vec2.hpp>

namespace copeel {

// Spreads samples evenly over the pixel; offsets are multiples of 2^-16, so that pixel coordinates stay exact.
// Based on: Roberts. The unreasonable effectiveness of quasirandom sequences. 2018 (R2 sequence).
inline glm::dvec2 sampleOffset(int index, int count) {
  if (count == 1) return {0, 0};
  const auto fraction = [&](double step) {
    const double x = 0.5 + index * step;
    return std::floor((x - std::floor(x)) * 65536) / 65536 - 0.5;
  };
  return {fraction(0.7548776662466927), fraction(0.5698402909980532)};
}

}  // namespace copeel
