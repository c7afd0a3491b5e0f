#include "validation/blend_oracle.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/geometric.hpp>

#include "validation/compare.h"

namespace copeel::validation {
namespace {

constexpr double kTie = 1e-9;   // of a level: an exact colour so near to a half may be rounded either way

OracleMesh placed(const oit::Part& part) {
  csg::Model model;
  model.leaves.push_back({part.mesh, part.worldFromObject, std::nullopt});
  return leafMesh(model, 0);
}

// 0.2 and what each light adds, both sides of a face alike.
double shadeOf(const OracleMesh& mesh, const glm::uvec3& t, const View& view, const std::vector<Light>& lights) {
  const glm::dvec3 a = mesh.vertices[t.x], normal = glm::cross(mesh.vertices[t.y] - a, mesh.vertices[t.z] - a);
  const double x = glm::dot(normal, glm::normalize(view.right)), y = -glm::dot(normal, glm::normalize(view.down)), z = -glm::dot(normal, view.forward);
  double shade = 0.2;
  for (const auto& [l, strength] : lights) shade += strength * std::abs(l.x * x + l.y * y + l.z * z) / (std::hypot(l.x, l.y, l.z) * glm::length(normal));
  return shade;
}

bool sameByte(std::uint8_t byte, double exact) {
  const double level = std::clamp(exact, 0.0, 255.0);
  return std::abs(byte - level) <= 0.5 + kTie;
}

}  // namespace

BlendOracle::BlendOracle(const std::vector<oit::Part>& parts, const View& view, const oit::RenderOptions& options)
    : background_(options.background[0], options.background[1], options.background[2]) {
  std::vector<OracleMesh> meshes;
  Box bounds;
  std::uint32_t first = 0;
  for (const oit::Part& part : parts) {
    meshes.push_back(placed(part));
    bounds.add(boundsOf(meshes.back()));
    firstTriangle_.push_back(first);
    first += static_cast<std::uint32_t>(meshes.back().triangles.size());
    colors_.emplace_back();
    for (std::size_t t = 0; t < meshes.back().triangles.size(); ++t) {
      const glm::dvec4 base(part.faceColors.empty() ? part.color : part.faceColors[t]);
      const double shade = options.lit ? shadeOf(meshes.back(), meshes.back().triangles[t], view, options.lights) : 1;
      colors_.back().emplace_back(glm::min(glm::dvec3(base) * shade, 255.0), base.a);
    }
  }
  diagonal_ = bounds.diagonal();
  tolerance_ = options.coplanarTolerance > 0 ? options.coplanarTolerance : declaredTolerance(bounds);
  caster_ = std::make_unique<RayCaster>(meshes, view);
}

glm::dvec4 BlendOracle::colorOf(const Crossing& crossing) const {
  return colors_[crossing.mesh][crossing.triangle - firstTriangle_[crossing.mesh]];
}

std::vector<std::vector<Crossing>> BlendOracle::groups(const Ray& ray) const {
  std::vector<Crossing> crossings = caster_->cross(ray);
  if (caster_->view().perspective) std::erase_if(crossings, [&](const Crossing& c) { return c.depth.value < kNearShare * diagonal_; });
  std::vector<std::vector<Crossing>> result;
  for (const Crossing& crossing : crossings) {
    if (result.empty() || !caster_->sameDepth(ray, result.back().front(), crossing, tolerance_)) result.emplace_back();
    result.back().push_back(crossing);
  }
  // Triangles are numbered through all parts, so the later one is the later part's or, within a part, the later.
  for (std::vector<Crossing>& group : result) {
    std::sort(group.begin(), group.end(), [](const Crossing& a, const Crossing& b) { return a.triangle > b.triangle; });
  }
  return result;
}

BlendAnswer BlendOracle::blend(const Ray& ray) const {
  BlendAnswer answer;
  answer.color = background_;
  const auto all = groups(ray);
  for (auto group = all.rbegin(); group != all.rend(); ++group) {
    answer.layers += static_cast<std::uint32_t>(group->size());
    answer.largestGroup = std::max(answer.largestGroup, static_cast<std::uint32_t>(group->size()));
    for (auto crossing = group->rbegin(); crossing != group->rend(); ++crossing) {
      const glm::dvec4 color = colorOf(*crossing);
      answer.color = glm::dvec3(color) * color.a + answer.color * (1 - color.a);
    }
  }
  return answer;
}

std::optional<Seen> BlendOracle::see(const Ray& ray) const {
  for (const std::vector<Crossing>& group : groups(ray)) {
    for (const Crossing& crossing : group) {
      if (colorOf(crossing).a > 0) return Seen{crossing.depth.value, crossing.mesh, crossing.triangle};
    }
  }
  return std::nullopt;
}

double BlendComparison::psnr() const {
  const double samples = 3.0 * static_cast<double>(pixels - edge);
  return squaredError > 0 ? 10 * std::log10(samples / squaredError) : std::numeric_limits<double>::infinity();
}

BlendComparison compareBlend(const oit::Frame& frame, const BlendOracle& oracle) {
  const View& view = oracle.caster().view();
  BlendComparison result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const Ray ray = oracle.caster().rayOf(x, y);
      const BlendAnswer exact = oracle.blend(ray);
      const Rgb8 seen = frame.color.at(x, y);
      const bool wrong = !sameByte(seen.r, exact.color.r) || !sameByte(seen.g, exact.color.g) || !sameByte(seen.b, exact.color.b);
      ++result.pixels;
      result.covered += exact.layers > 0;
      if (oracle.caster().nearEdge(ray, kSubPixelStep)) {
        ++result.edge;
        result.wrongOnEdge += wrong;
        continue;
      }
      result.wrongOffEdge += wrong;
      result.wrongCountsOffEdge += frame.layers.at(x, y) != std::min(exact.layers, 65535u) || frame.coplanar.at(x, y) != std::min(exact.largestGroup, 65535u);
      const glm::dvec3 error = (glm::dvec3(frame.floats.at(x, y)) - exact.color) / 255.0;
      result.squaredError += glm::dot(error, error);
      for (int c = 0; c < 3; ++c) result.greatestError = std::max(result.greatestError, std::abs(error[c]));
    }
  }
  return result;
}

}  // namespace copeel::validation
