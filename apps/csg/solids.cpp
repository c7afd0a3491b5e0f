// Rounded the way openscad rounds: angles are formed in degrees, 360 · i / n, and a sphere's rings stand at half steps, so that it has
// no poles. All faces here are convex and planar.
#include "apps/csg/solids.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/csg/degrees.h"
#include "apps/csg/mesh_builder.h"

namespace copeel::csg {
namespace {

constexpr double kTwoPi = 2 * 3.14159265358979323846;
constexpr double kFineGrid = 0.00000095367431640625;   // 2^-20: openscad takes a smaller radius for a triangle
constexpr double kSmallestStep = 0.01;                 // $fa and $fs are held above it

// Adds the n corners of a circle and returns the index of the first.
std::uint32_t addRing(MeshBuilder& builder, double r, double z, int n) {
  const std::uint32_t first = builder.addVertex({circlePoint(r, 0, n), z});
  for (int i = 1; i < n; ++i) builder.addVertex({circlePoint(r, i, n), z});
  return first;
}

std::vector<std::uint32_t> ringCorners(std::uint32_t first, int n, bool facingUp) {
  std::vector<std::uint32_t> corners(static_cast<std::size_t>(n));
  for (int i = 0; i < n; ++i) corners[static_cast<std::size_t>(i)] = first + static_cast<std::uint32_t>(facingUp ? i : n - 1 - i);
  return corners;
}

// The wall between a lower and an upper ring of n corners, one facet a quad.
void addWall(MeshBuilder& builder, std::uint32_t lower, std::uint32_t upper, std::uint32_t n) {
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = i + 1 < n ? i + 1 : 0;
    builder.addQuadFacet(lower + i, lower + j, upper + j, upper + i);
  }
}

// A cone's wall: one of its rings is a single apex.
void addCone(MeshBuilder& builder, std::uint32_t ring, std::uint32_t apex, std::uint32_t n, bool apexAbove) {
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t j = i + 1 < n ? i + 1 : 0;
    if (apexAbove) {
      builder.addTriangleFacet(ring + i, ring + j, apex);
    } else {
      builder.addTriangleFacet(ring + j, ring + i, apex);
    }
  }
}

}  // namespace

int fragmentCount(double r, const Fragments& fragments) {
  if (r < kFineGrid || std::isinf(fragments.fn) || std::isnan(fragments.fn)) return 3;
  double count = fragments.fn >= 3 ? fragments.fn : 3;
  if (!(fragments.fn > 0)) {
    const double fa = std::max(fragments.fa, kSmallestStep);
    const double fs = std::max(fragments.fs, kSmallestStep);
    count = std::ceil(std::fmax(std::fmin(360.0 / fa, r * kTwoPi / fs), 5));
  }
  if (!(count <= kMaxFragments)) throw std::length_error("more than 1000000 fragments");
  return static_cast<int>(count);
}

glm::dvec2 circlePoint(double r, int i, int n) {
  const double degrees = 360.0 * i / n;
  return {r * cosDegrees(degrees), r * sinDegrees(degrees)};
}

MeshPointer makeCube(const glm::dvec3& size, bool center) {
  const auto good = [](double x) { return x > 0 && std::isfinite(x); };
  if (!good(size.x) || !good(size.y) || !good(size.z)) return nullptr;
  const glm::dvec3 low = center ? -size / 2.0 : glm::dvec3(0);
  const glm::dvec3 high = center ? size / 2.0 : size;
  MeshBuilder builder;
  for (unsigned corner = 0; corner < 8; ++corner) {
    builder.addVertex({corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y, corner & 4 ? high.z : low.z});
  }
  builder.addQuadFacet(4, 5, 7, 6);
  builder.addQuadFacet(2, 3, 1, 0);
  builder.addQuadFacet(0, 1, 5, 4);
  builder.addQuadFacet(1, 3, 7, 5);
  builder.addQuadFacet(3, 2, 6, 7);
  builder.addQuadFacet(2, 0, 4, 6);
  return builder.finish();
}

MeshPointer makeSphere(double r, const Fragments& fragments) {
  if (!(r > 0) || std::isinf(r)) return nullptr;
  const int n = fragmentCount(r, fragments);
  const int rings = (n + 1) / 2;
  if (static_cast<double>(n) * rings > kMaxSolidCorners) throw std::length_error("more than 2e7 corners");
  MeshBuilder builder;
  std::vector<std::uint32_t> firsts;
  for (int i = 0; i < rings; ++i) {
    const double degrees = 180.0 * (i + 0.5) / rings;
    firsts.push_back(addRing(builder, r * sinDegrees(degrees), r * cosDegrees(degrees), n));
  }
  builder.addConvexFacet(ringCorners(firsts.front(), n, true));
  for (std::size_t i = 0; i + 1 < firsts.size(); ++i) addWall(builder, firsts[i + 1], firsts[i], static_cast<std::uint32_t>(n));
  builder.addConvexFacet(ringCorners(firsts.back(), n, false));
  return builder.finish();
}

MeshPointer makeCylinder(double h, double r1, double r2, bool center, const Fragments& fragments) {
  const bool sound = h > 0 && std::isfinite(h) && r1 >= 0 && r2 >= 0 && (r1 > 0 || r2 > 0) && std::isfinite(r1) && std::isfinite(r2);
  if (!sound) return nullptr;
  const int n = fragmentCount(std::fmax(r1, r2), fragments);
  const double low = center ? -h / 2 : 0;
  const double high = center ? h / 2 : h;
  MeshBuilder builder;
  const std::uint32_t lower = r1 > 0 ? addRing(builder, r1, low, n) : builder.addVertex({0, 0, low});
  const std::uint32_t upper = r2 > 0 ? addRing(builder, r2, high, n) : builder.addVertex({0, 0, high});
  const auto count = static_cast<std::uint32_t>(n);
  if (r1 > 0 && r2 > 0) {
    addWall(builder, lower, upper, count);
  } else if (r1 > 0) {
    addCone(builder, lower, upper, count, true);
  } else {
    addCone(builder, upper, lower, count, false);
  }
  if (r1 > 0) builder.addConvexFacet(ringCorners(lower, n, false));
  if (r2 > 0) builder.addConvexFacet(ringCorners(upper, n, true));
  return builder.finish();
}

}  // namespace copeel::csg
