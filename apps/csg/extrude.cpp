// Walls are laid slice by slice. A wall quad that may be bent (a twist, a scale of unlike factors) is split along its shorter diagonal,
// the one openscad takes, and its halves are facets of their own; a straight one is one facet.
#include "apps/csg/extrude.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "apps/csg/degrees.h"

namespace copeel::csg {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kFineGrid = 0.00000095367431640625;   // 2^-20
constexpr double kDegreesPerSlice = 120;               // more twist in a slice would turn a wall inside out
constexpr double kSameLength = 1e-5;                   // diagonals that differ less, relative to their mean, count as equal

double lengthOf(const glm::dvec2& v) { return std::sqrt(v.x * v.x + v.y * v.y); }

double largestSquare(const Flat& flat, const glm::dvec2& factor) {
  double largest = 0;
  for (const Outline& outline : flat.outlines) {
    for (const glm::dvec2& p : outline.points) {
      const glm::dvec2 q = p * factor;
      largest = std::fmax(largest, q.x * q.x + q.y * q.y);
    }
  }
  return largest;
}

double archimedesLength(double a, double theta) { return 0.5 * a * (theta * std::sqrt(1 + theta * theta) + std::asinh(theta)); }

// The length of the way of a point that turns by `radians` and rises by `height`, its distance from the axis going from r to r · scale.
double helixLength(double r, double height, double radians, double scale) {
  if (scale == 1) {
    const double pitch = height / radians;
    return radians * std::sqrt(r * r + pitch * pitch);
  }
  const double end = scale > 1 ? radians * scale / (scale - 1) : radians / (1 - scale);
  const double a = r / end;
  const double spiral = archimedesLength(a, end) - archimedesLength(a, end - radians);
  return std::sqrt(spiral * spiral + height * height);
}

double twistSlices(const Flat& flat, const LinearExtrusion& how) {
  const double twist = std::abs(how.twist);
  const Fragments& f = how.fragments;
  const double fewest = std::max(std::ceil(twist / kDegreesPerSlice), 1.0);
  const double r = std::sqrt(largestSquare(flat, {1, 1}));
  if (r < kFineGrid || !std::isfinite(f.fn)) return fewest;
  const bool conical = how.scale.x == how.scale.y && how.scale.x != 1;
  if (f.fn > 0) return std::max(std::ceil(conical ? twist * f.fn / 360 : twist / 360.0 * f.fn), fewest);
  const double byLength = std::ceil(helixLength(r, how.height, twist * kPi / 180, conical ? how.scale.x : 1) / f.fs);
  return std::max(std::min(std::ceil(twist / f.fa), byLength), fewest);
}

double scaleSlices(const Flat& flat, const LinearExtrusion& how) {
  const Fragments& f = how.fragments;
  const double square = largestSquare(flat, {1 - how.scale.x, 1 - how.scale.y});
  if (std::sqrt(square) < kFineGrid || !std::isfinite(f.fn)) return 1;
  if (f.fn > 0) return std::max(std::floor(f.fn), 1.0);
  return std::max(std::ceil(std::sqrt(square + how.height * how.height) / f.fs), 1.0);
}

double sliceCount(const Flat& flat, const LinearExtrusion& how) {
  if (how.slices) return *how.slices;
  const bool unlike = how.scale.x != how.scale.y;
  if (how.hasTwist) return twistSlices(flat, how);
  return unlike ? scaleSlices(flat, how) : 1;
}

// The plane of the shape at a fraction of the height.
struct Level {
  glm::dvec2 scale;
  double turn;       // degrees
  double z;
};

std::vector<std::uint32_t> addLevel(MeshBuilder& builder, const Flat& flat, const Level& level) {
  // Scale times rotation is formed first, as openscad forms it: the order of roundings is the same.
  const double cosine = cosDegrees(-level.turn), sine = sinDegrees(-level.turn);
  const glm::dvec2 x(level.scale.x * cosine, level.scale.y * sine), y(level.scale.x * -sine, level.scale.y * cosine);
  return addOutlines(builder, flat, [&](const glm::dvec2& p) { return glm::dvec3(x.x * p.x + y.x * p.y, x.y * p.x + y.y * p.y, level.z); });
}

// Which diagonal openscad takes: true, the one from the lower left to the upper right corner.
bool splitsFirst(const glm::dvec3& lowerLeft, const glm::dvec3& lowerRight, const glm::dvec3& upperLeft, const glm::dvec3& upperRight, bool flip) {
  const double first = lengthOf(glm::dvec2(lowerLeft) - glm::dvec2(upperRight));
  const double second = lengthOf(glm::dvec2(lowerRight) - glm::dvec2(upperLeft));
  const bool differ = 2 * std::abs(first - second) > kSameLength * (first + second);
  return differ ? first < second : !flip;
}

struct WallStyle {
  bool straight;     // quads are planar
  bool backTwist;
  bool anyZero;      // a factor of the upper scale is 0
  bool allZero;
};

void addWallQuad(MeshBuilder& builder, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d, bool positive, const WallStyle& style) {
  // a, b below and d, c above them; the solid lies to the left of a-b.
  if (style.allZero) return builder.addTriangleFacet(a, b, d);
  const bool flip = !positive != style.backTwist;
  const bool first = splitsFirst(builder.vertex(a), builder.vertex(b), builder.vertex(d), builder.vertex(c), flip) != style.anyZero;
  const bool twoUpper = !style.anyZero || builder.vertex(c) != builder.vertex(d);
  if (first) {
    builder.addTriangleFacet(a, b, c);
    if (!style.straight) builder.beginFacet();
    if (twoUpper) builder.addTriangle(a, c, d);
  } else {
    builder.addTriangleFacet(a, b, d);
    if (!style.straight) builder.beginFacet();
    if (twoUpper) builder.addTriangle(b, c, d);
  }
}

void addWalls(MeshBuilder& builder, const Flat& flat, const std::vector<std::uint32_t>& lower, const std::vector<std::uint32_t>& upper,
              const WallStyle& style) {
  for (std::size_t o = 0; o < flat.outlines.size(); ++o) {
    const auto n = static_cast<std::uint32_t>(flat.outlines[o].points.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = i + 1 < n ? i + 1 : 0;
      addWallQuad(builder, lower[o] + i, lower[o] + j, upper[o] + j, upper[o] + i, flat.outlines[o].positive, style);
    }
  }
}

// A quad between two steps of a turn; where an edge lies on the axis it is a triangle, or nothing.
void addTurnedQuad(MeshBuilder& builder, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  const auto same = [&](std::uint32_t p, std::uint32_t q) { return builder.vertex(p) == builder.vertex(q); };
  builder.beginFacet();
  if (!same(a, b) && !same(b, c)) builder.addTriangle(a, b, c);
  if (!same(a, d) && !same(d, c)) builder.addTriangle(a, c, d);
}

}  // namespace

MeshPointer extrude(const Flat& flat, const LinearExtrusion& how) {
  if (!(how.height > 0) || std::isinf(how.height) || flat.empty()) return nullptr;
  const double slices = std::max(sliceCount(flat, how), 1.0);
  if (!(slices * static_cast<double>(flat.pointCount()) <= kMaxSolidCorners)) throw std::length_error("more than 2e7 corners");
  const double low = how.center ? -how.height / 2 : 0;
  const double high = how.center ? how.height / 2 : how.height;
  MeshBuilder builder;
  std::vector<std::uint32_t> below = addLevel(builder, flat, {{1, 1}, 0, low});
  const std::vector<glm::uvec3> area = areaOf(flat);
  addArea(builder, area, 0, true);
  WallStyle style{how.twist == 0 && how.scale.x == how.scale.y, how.twist <= 0, false, false};
  for (int j = 1; j <= slices; ++j) {
    const glm::dvec2 scale(1 - (1 - how.scale.x) * j / slices, 1 - (1 - how.scale.y) * j / slices);
    const std::vector<std::uint32_t> above = addLevel(builder, flat, {scale, how.twist * j / slices, low + (high - low) * j / slices});
    style.anyZero = scale.x == 0 || scale.y == 0;
    style.allZero = scale.x == 0 && scale.y == 0;
    addWalls(builder, flat, below, above, style);
    below = above;
  }
  // Where a factor is 0, the upper face is a line and walls have met there.
  if (how.scale.x > 0 && how.scale.y > 0) addArea(builder, area, below.front(), false);
  return builder.finish();
}

bool crossesAxis(const Flat& flat) {
  double low = 0, high = 0;
  for (const Outline& outline : flat.outlines) {
    for (const glm::dvec2& p : outline.points) {
      low = std::fmin(low, p.x);
      high = std::fmax(high, p.x);
    }
  }
  return high - low > high && high - low > std::abs(low);
}

MeshPointer rotateExtrude(const Flat& flat, double angle, const Fragments& fragments) {
  if (flat.empty() || angle == 0 || !std::isfinite(angle) || crossesAxis(flat)) return nullptr;
  double low = 0, high = 0;
  for (const Outline& outline : flat.outlines) {
    for (const glm::dvec2& p : outline.points) {
      low = std::fmin(low, p.x);
      high = std::fmax(high, p.x);
    }
  }
  const bool full = angle == 360;
  const int steps = std::max(static_cast<int>(fragmentCount(high - low, fragments) * std::abs(angle) / 360), 1);
  if (!(static_cast<double>(steps) * static_cast<double>(flat.pointCount()) <= kMaxSolidCorners)) throw std::length_error("more than 2e7 corners");
  MeshBuilder builder;
  // A full turn starts on the negative x axis, a part of one on the positive; angles as openscad forms them, from the y axis.
  const auto addStep = [&](int step) {
    const double degrees = full ? -90 + (step % steps) * 360.0 / steps : 90 - step * angle / steps;
    const double x = sinDegrees(degrees), y = cosDegrees(degrees);
    return addOutlines(builder, flat, [&](const glm::dvec2& p) { return glm::dvec3(p.x * x, p.x * y, p.y); });
  };
  // Seen from outside, a profile on the positive side that turns to the left has its solid on the other hand.
  const bool leftTurn = full ? false : angle > 0;
  const bool reversed = leftTurn != (low < 0);
  std::vector<std::uint32_t> first = addStep(0), below = first;
  const std::vector<glm::uvec3> area = full ? std::vector<glm::uvec3>{} : areaOf(flat);
  if (!full) addArea(builder, area, first.front(), !reversed);
  for (int j = 1; j <= steps; ++j) {
    const std::vector<std::uint32_t> above = full && j == steps ? first : addStep(j);
    for (std::size_t o = 0; o < flat.outlines.size(); ++o) {
      const auto n = static_cast<std::uint32_t>(flat.outlines[o].points.size());
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t k = i + 1 < n ? i + 1 : 0;
        const std::uint32_t a = below[o] + i, b = below[o] + k, c = above[o] + k, d = above[o] + i;
        addTurnedQuad(builder, a, reversed ? d : b, c, reversed ? b : d);
      }
    }
    below = above;
  }
  if (!full) addArea(builder, area, below.front(), reversed);
  return builder.finish();
}

MeshPointer slabOf(const Flat& flat) {
  LinearExtrusion how;
  how.height = 1;
  how.center = true;
  return extrude(flat, how);
}

}  // namespace copeel::csg
