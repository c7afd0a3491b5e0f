// The colour a ray through transparent meshes must show: all crossings in exact order, those of one depth as DESIGN.md orders them (the later
// part in front, within a part the later triangle), blended from the back in double. Shares no code with the renderer.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include <glm/vec3.hpp>

#include "apps/oit/render_oit.h"
#include "validation/oracle.h"

namespace copeel::validation {

struct BlendAnswer {
  glm::dvec3 color{0};                 // 0 … 255
  std::uint32_t layers = 0;            // fragments
  std::uint32_t largestGroup = 0;      // fragments at one depth
};

class BlendOracle : public Oracle {
 public:
  BlendOracle(const std::vector<oit::Part>& parts, const View& view, const oit::RenderOptions& options);

  BlendAnswer blend(const Ray& ray) const;
  std::optional<Seen> see(const Ray& ray) const override;   // the nearest surface that is not wholly transparent
  const RayCaster& caster() const override { return *caster_; }
  double tolerance() const override { return tolerance_; }
  double diagonal() const override { return diagonal_; }

 private:
  std::vector<std::vector<Crossing>> groups(const Ray& ray) const;   // nearest first; within a group, the foremost first
  glm::dvec4 colorOf(const Crossing& crossing) const;

  std::vector<std::vector<glm::dvec4>> colors_;   // per part and triangle, under the light
  std::vector<std::uint32_t> firstTriangle_;      // per part
  glm::dvec3 background_;
  std::unique_ptr<RayCaster> caster_;
  double tolerance_ = 0, diagonal_ = 0;
};

// A frame against the oracle, edge pixels apart. It must have floats, layers and coplanar.
struct BlendComparison {
  std::uint64_t pixels = 0, covered = 0, edge = 0;
  std::uint64_t wrongOffEdge = 0;          // another 8-bit colour than the exact one rounded
  std::uint64_t wrongOnEdge = 0;
  std::uint64_t wrongCountsOffEdge = 0;    // layers or largest group
  double greatestError = 0;                // of a channel off edges, 0 … 1, before rounding
  double squaredError = 0;                 // summed over channels off edges, 0 … 1
  double psnr() const;                     // of the floats off edges, decibels
};
BlendComparison compareBlend(const oit::Frame& frame, const BlendOracle& oracle);

}  // namespace copeel::validation
