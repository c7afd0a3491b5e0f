// Coverage as the rule says it, in arithmetic wide enough to be exact whatever the corners: what the rasterizer is compared with.
#pragma once

#include <cstdint>
#include <utility>

#include <glm/vec2.hpp>

namespace copeel::test {

// Whether a triangle covers the sample at grid coordinates (x, y). The top-left rule spelt out: a sample on an edge is covered when the edge is a top or a left one.
inline bool covers(const glm::ivec2 (&corner)[3], std::int64_t x, std::int64_t y) {
  using Wide = __int128;
  const auto edge = [&](int i, Wide px, Wide py) {
    const glm::ivec2 a = corner[i], b = corner[(i + 1) % 3];
    return (Wide(b.x) - a.x) * (py - a.y) - (Wide(b.y) - a.y) * (px - a.x);
  };
  const Wide area = edge(0, corner[2].x, corner[2].y);
  if (area == 0) return false;
  for (int i = 0; i < 3; ++i) {
    const Wide e = area > 0 ? edge(i, x, y) : -edge(i, x, y);
    if (e < 0) return false;
    if (e > 0) continue;
    // Inside lies to the right of a left edge and, y pointing down, below a top edge.
    glm::ivec2 a = corner[i], b = corner[(i + 1) % 3];
    if (area < 0) std::swap(a, b);
    const bool left = b.y < a.y, top = b.y == a.y && b.x > a.x;
    if (!left && !top) return false;
  }
  return true;
}

}  // namespace copeel::test
