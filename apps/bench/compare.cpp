#include "apps/bench/compare.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

#include "core/scene/scene.h"

namespace copeel::bench {
namespace {

constexpr double kSubPixelStep = 1.0 / 256;   // pixels: llvmpipe's and most GPUs' grid of vertices
constexpr float kHalfLevel = 0.5f;            // of 255

// In pixels, whole numbers at the centres of pixels.
glm::dvec2 project(const glm::dvec3& world, const View& view) {
  const glm::dvec3 ray = world - view.eye;
  const double t = view.perspective ? glm::dot(ray, view.forward) : 1.0;
  const double u = glm::dot(ray, view.right) / (glm::dot(view.right, view.right) * t), v = glm::dot(ray, view.down) / (glm::dot(view.down, view.down) * t);
  return {u + view.width * 0.5 - 0.5 - view.offset.x, v + view.height * 0.5 - 0.5 - view.offset.y};
}

double distanceToSegment(const glm::dvec2& p, const glm::dvec2& a, const glm::dvec2& b) {
  const glm::dvec2 along = b - a;
  const double length2 = glm::dot(along, along), t = length2 > 0 ? std::clamp(glm::dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return glm::length(p - (a + t * along));
}

// Along the axis in which the segment is longer, the pixel nearest to it in each column (or row) is the only one that can be that close.
void markSegment(glm::dvec2 a, glm::dvec2 b, const View& view, std::vector<std::uint8_t>& marks) {
  const int axis = std::abs(b.x - a.x) >= std::abs(b.y - a.y) ? 0 : 1, other = 1 - axis;
  if (a[axis] > b[axis]) std::swap(a, b);
  const std::array<int, 2> size{view.width, view.height};
  const double first = std::max(0.0, std::ceil(a[axis] - kSubPixelStep)), last = std::min(size[axis] - 1.0, std::floor(b[axis] + kSubPixelStep));
  const double length = b[axis] - a[axis];
  for (double at = first; at <= last; ++at) {
    glm::dvec2 p;
    p[axis] = at;
    p[other] = std::round(length > 0 ? a[other] + (b[other] - a[other]) * std::clamp((at - a[axis]) / length, 0.0, 1.0) : a[other]);
    if (p[other] < 0 || p[other] >= size[other] || distanceToSegment(p, a, b) > kSubPixelStep) continue;
    marks[static_cast<std::size_t>(p.y) * static_cast<std::size_t>(view.width) + static_cast<std::size_t>(p.x)] = 1;
  }
}

float difference(const glm::vec3& a, const glm::vec3& b) {
  const glm::vec3 d = glm::abs(a - b);
  return std::max({d.r, d.g, d.b});
}

}  // namespace

std::vector<std::uint8_t> edgePixels(const std::vector<oit::Part>& parts, const View& view) {
  std::vector<std::uint8_t> marks(static_cast<std::size_t>(view.width) * static_cast<std::size_t>(view.height));
  for (const oit::Part& part : parts) {
    std::vector<glm::dvec2> projected;
    for (const glm::dvec3& vertex : part.mesh->vertices) projected.push_back(project(transformPoint(part.worldFromObject, vertex), view));
    for (const glm::uvec3& t : part.mesh->triangles) {
      for (int i = 0; i < 3; ++i) markSegment(projected[t[i]], projected[t[(i + 1) % 3]], view, marks);
    }
  }
  return marks;
}

FrameError compare(const oit::Frame& frame, const oit::Frame& reference, const std::vector<std::uint8_t>& onEdge) {
  FrameError error;
  double squares = 0;
  std::uint64_t offEdge = 0;
  for (std::size_t i = 0; i < onEdge.size(); ++i) {
    const float worst = difference(frame.floats.pixels[i], reference.floats.pixels[i]);
    if (onEdge[i]) {
      error.wrongOnEdges += worst > kHalfLevel;
      continue;
    }
    const glm::dvec3 d = glm::dvec3(frame.floats.pixels[i]) - glm::dvec3(reference.floats.pixels[i]);
    squares += glm::dot(d, d);
    ++offEdge;
    const float depth = frame.depth.pixels[i], true_ = reference.depth.pixels[i];
    error.compared += std::isfinite(true_) || worst > 0;
    error.wrong += worst > kHalfLevel;
    if (depth != true_) error.depth = std::max(error.depth, std::abs(double(depth) - double(true_)));
  }
  const double mean = offEdge ? squares / (3.0 * double(offEdge)) : 0;
  error.psnr = mean > 0 ? 10 * std::log10(255.0 * 255.0 / mean) : std::numeric_limits<double>::infinity();
  return error;
}

Image<Rgb8> errorMap(const oit::Frame& frame, const oit::Frame& reference, const std::vector<std::uint8_t>& onEdge) {
  Image<Rgb8> map(frame.color.width, frame.color.height);
  for (std::size_t i = 0; i < onEdge.size(); ++i) {
    const float worst = difference(frame.floats.pixels[i], reference.floats.pixels[i]);
    const Rgb8& seen = reference.color.pixels[i];
    const auto grey = static_cast<std::uint8_t>(160 + (seen.r + seen.g + seen.b) / 9);
    const double heat = std::clamp(std::log2(double(worst) / kHalfLevel + 1e-9) / 7, 0.0, 1.0);   // 7 doublings of half a level are 64 levels
    if (worst <= kHalfLevel) map.pixels[i] = {grey, grey, grey};
    else if (onEdge[i]) map.pixels[i] = {40, 80, 255};
    else map.pixels[i] = {255, static_cast<std::uint8_t>(210 * (1 - heat)), 0};
  }
  return map;
}

}  // namespace copeel::bench
