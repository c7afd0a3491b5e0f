// Forms plane classes: facets sorted from large to small, each tried against the classes that a hash of (normal, offset) finds near it.
#include "core/coplanarity/plane_classes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>
#include <utility>

#include <glm/geometric.hpp>

#include "core/parallel.h"

namespace copeel {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kRelativeTolerance = 1e-10;   // of the diagonal, for double coordinates
constexpr double kFloatUlps = 4;               // for coordinates that came as float
constexpr double kDoubleUlps = 16;             // least tolerance: two products of matrices and a rounding each
// A facet of the size of a pixel (1e-3 of the scene) within the tolerance is turned by 1e3 tolerances at most: the margin of the hash.
constexpr double kMarginPerTolerance = 1e3;
constexpr double kCellPerMargin = 10;
constexpr double kLargestCell = 0.05;
constexpr std::size_t kBlock = 8192;   // facets measured at a time

// What sorting needs of a placed facet: 20 bytes, as there is one for every triangle of a soup.
struct FacetKey {
  float area = 0;               // of its largest triangle, doubled
  std::uint32_t tie = 0;        // hash of the plane: facets of equal area fall in an order of geometry, not of input
  std::uint32_t object = 0, facet = 0, triangle = 0;
};

struct Facet {
  FacetKey key;
  glm::dvec3 normal{0, 0, 1};   // unit, turned into the half-space of kHalf
  glm::dvec3 point{0};          // the first corner of its largest triangle
  double offset = 0;            // of the plane from the scene's centre, in diagonals
  double error = 0;             // bound of |normal - true normal|
  double flatness = 0;          // largest distance of a corner from the facet's own plane
  double radius = 0;            // largest distance of a corner from `point`
  Box box;
};

// No plane of practice is orthogonal to this direction, so that the sign of a normal is stable under rounding.
const glm::dvec3 kHalf = glm::normalize(glm::dvec3(0.3568220897730899, 0.5773502691896258, 0.7343224509861237));

// First triangle of each facet of a mesh, and the end.
std::vector<std::uint32_t> facetStarts(const Mesh& mesh) {
  std::vector<std::uint32_t> starts;
  if (mesh.facets.empty()) return starts;
  starts.reserve(mesh.facetCount() + 1);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    while (starts.size() <= mesh.facets[t]) starts.push_back(t);
  }
  starts.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
  return starts;
}

struct FacetRange {
  std::uint32_t begin, end;
};

FacetRange rangeOf(const std::vector<std::uint32_t>& starts, std::uint32_t facet) {
  if (starts.empty()) return {facet, facet + 1};
  return {starts[facet], starts[facet + 1]};
}

// A normal for a facet without area: orthogonal to its longest edge. It covers edge pixels at most, and its depth is held to its range.
glm::dvec3 needleNormal(const glm::dvec3& p, const glm::dvec3& q, const glm::dvec3& r) {
  glm::dvec3 along = q - p;
  for (const glm::dvec3& other : {r - p, r - q}) {
    if (glm::dot(other, other) > glm::dot(along, along)) along = other;
  }
  const glm::dvec3 side = std::abs(along.x) < std::abs(along.y) ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 normal = glm::cross(along, side);
  const double length = glm::length(normal);
  return length > 0 && std::isfinite(length) ? normal / length : glm::dvec3(0, 0, 1);
}

// The facet's largest triangle, its plane and extent.
Facet measure(const Scene& scene, std::uint32_t object, std::uint32_t facet, FacetRange range) {
  Facet result;
  result.key.object = object, result.key.facet = facet;
  thread_local std::vector<glm::dvec3> corners;
  corners.clear();
  const Object& placed = scene.objects()[object];
  const auto place = [&](std::uint32_t triangle, int k) {
    return transformPoint(placed.worldFromObject, placed.mesh->vertices[placed.mesh->triangles[triangle][k]]);
  };
  double best = -1, magnitude = 0;
  glm::dvec3 normal{0}, second{0}, third{0};
  for (std::uint32_t t = range.begin; t < range.end; ++t) {
    const glm::dvec3 a = place(t, 0), b = place(t, 1), c = place(t, 2);
    result.box.add(a), result.box.add(b), result.box.add(c);
    corners.insert(corners.end(), {a, b, c});
    const glm::dvec3 n = glm::cross(b - a, c - a);
    const double area = glm::length(n);
    if (!(area > best)) continue;
    best = area, normal = n, result.point = a, second = b, third = c, result.key.triangle = t;
    magnitude = glm::length(b - a) * glm::length(c - a);
  }
  // Each component of the cross product carries four roundings of products no larger than the two edges'.
  const double error = best > 0 ? 8 * kEps * magnitude / best : 1.0;
  result.normal = error < 0.25 ? normal / best : needleNormal(result.point, second, third);
  if (glm::dot(result.normal, kHalf) < 0) result.normal = -result.normal;
  result.error = std::min(error * 1.001 + 4 * kEps, 1.0);
  result.key.area = static_cast<float>(best);
  double radiusSquared = 0;
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 away = corner - result.point;
    result.flatness = std::max(result.flatness, std::abs(glm::dot(result.normal, away)));
    radiusSquared = std::max(radiusSquared, glm::dot(away, away));
  }
  result.radius = std::sqrt(radiusSquared) * (1 + 4 * kEps);
  return result;
}

std::uint32_t planeHash(const glm::dvec3& normal, double offset) {
  std::uint64_t h = 0x9E3779B97F4A7C15ull;
  for (double v : {normal.x, normal.y, normal.z, offset}) h = (h ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0xD6E8FEB86659FD93ull, h ^= h >> 32;
  return static_cast<std::uint32_t>(h);
}

// Classes by cell of (normal, offset). A bucket of the table holds the cells that hash to it; chains are threaded through `chain_`.
class ClassIndex {
 public:
  ClassIndex(double margin, std::size_t expected)
      : cell_(std::min(margin * kCellPerMargin, kLargestCell)), margin_(margin / cell_), heads_(std::bit_ceil(expected * 2 + 1), kEnd) {}

  void insert(const Facet& facet, std::uint32_t planeClass) {
    const std::uint32_t hash = hashOf(cellOf(facet.normal, facet.offset));
    chain_.resize(planeClass + 1);
    chain_[planeClass] = {std::exchange(heads_[hash & (heads_.size() - 1)], planeClass), hash};
  }

  // The first class for which `accept` holds among those whose plane may agree; kEnd if none.
  template <class Accept>
  std::uint32_t find(const Facet& facet, Accept accept) const {
    std::uint32_t found = search(facet.normal, facet.offset, accept);
    const bool signUnstable = std::abs(glm::dot(facet.normal, kHalf)) < margin_ * cell_;
    if (found == kEnd && signUnstable) found = search(-facet.normal, -facet.offset, accept);
    return found;
  }

  static constexpr std::uint32_t kEnd = ~std::uint32_t{0};

 private:
  using Cell = std::array<double, 4>;   // whole numbers

  Cell cellOf(const glm::dvec3& n, double offset) const {
    return {std::rint(n.x / cell_), std::rint(n.y / cell_), std::rint(n.z / cell_), std::rint(offset / cell_)};
  }
  static std::uint32_t hashOf(const Cell& cell) { return planeHash({cell[0], cell[1], cell[2]}, cell[3]); }

  template <class Accept>
  std::uint32_t search(const glm::dvec3& n, double offset, Accept accept) const {
    const double at[4] = {n.x / cell_, n.y / cell_, n.z / cell_, offset / cell_};
    const Cell home = cellOf(n, offset);
    // A coordinate within the margin of its cell's border may have its class next door.
    int near[4], nearCount = 0;
    double step[4];
    for (int i = 0; i < 4; ++i) {
      const double inside = at[i] - home[i];
      if (std::abs(inside) <= 0.5 - margin_) continue;
      near[nearCount] = i, step[nearCount++] = inside > 0 ? 1 : -1;
    }
    for (int corner = 0; corner < 1 << nearCount; ++corner) {
      Cell cell = home;
      for (int i = 0; i < nearCount; ++i) cell[near[i]] += corner >> i & 1 ? step[i] : 0;
      const std::uint32_t hash = hashOf(cell);
      for (std::uint32_t c = heads_[hash & (heads_.size() - 1)]; c != kEnd; c = chain_[c].next) {
        if (chain_[c].hash == hash && accept(c)) return c;
      }
    }
    return kEnd;
  }

  double cell_, margin_;   // margin in cells
  struct Link {
    std::uint32_t next, hash;   // of its cell: classes of other cells in the bucket are passed over unseen
  };
  std::vector<std::uint32_t> heads_;
  std::vector<Link> chain_;
};

float below(double v) { return std::nextafter(static_cast<float>(v), -std::numeric_limits<float>::infinity()); }
float above(double v) { return std::nextafter(static_cast<float>(v), std::numeric_limits<float>::infinity()); }

void widen(PlaneClass& planeClass, const Box& box) {
  for (int i = 0; i < 3; ++i) {
    if (box.min[i] < planeClass.boundsMin[i]) planeClass.boundsMin[i] = below(box.min[i]);
    if (box.max[i] > planeClass.boundsMax[i]) planeClass.boundsMax[i] = above(box.max[i]);
  }
}

double largestCoordinate(const Box& bounds) {
  if (bounds.empty()) return 0;
  const glm::dvec3 m = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return std::max({m.x, m.y, m.z});
}

// Every corner within the tolerance of the class's plane. The plane of the facet and its extent mostly tell without looking at the corners.
bool agrees(const Scene& scene, const Facet& facet, const PlaneClass& planeClass, const std::vector<std::uint32_t>& starts,
            double tolerance) {
  const Object& placed = scene.objects()[planeClass.object];
  const glm::dvec3 point = transformPoint(placed.worldFromObject, placed.mesh->vertices[placed.mesh->triangles[planeClass.triangle].x]);
  const double at = std::abs(glm::dot(planeClass.normal, facet.point - point));
  if (at > tolerance) return false;
  const glm::dvec3 turn = glm::dot(facet.normal, planeClass.normal) < 0 ? facet.normal + planeClass.normal : facet.normal - planeClass.normal;
  if (at + facet.flatness + glm::length(turn) * facet.radius <= tolerance) return true;
  const Mesh& mesh = *scene.objects()[facet.key.object].mesh;
  const FacetRange range = rangeOf(starts, facet.key.facet);
  for (std::uint32_t t = range.begin; t < range.end; ++t) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 v = scene.worldVertex(facet.key.object, mesh.triangles[t][k]);
      if (std::abs(glm::dot(planeClass.normal, v - point)) > tolerance) return false;
    }
  }
  return true;
}

}  // namespace

double defaultCoplanarTolerance(const Scene& scene) {
  const double largest = largestCoordinate(scene.bounds());
  double tolerance = std::max(kRelativeTolerance * scene.bounds().diagonal(), kDoubleUlps * kEps * largest);
  for (const Object& object : scene.objects()) {
    if (!object.mesh->singlePrecision) continue;
    tolerance = std::max(tolerance, kFloatUlps * double(std::numeric_limits<float>::epsilon()) * largest);
    break;
  }
  return tolerance;
}

PlaneClasses::PlaneClasses(const Scene& scene, double tolerance)
    : tolerance_(tolerance > 0 ? tolerance : defaultCoplanarTolerance(scene)) {
  // Number the placed facets, and find the facets of each shared mesh once.
  std::unordered_map<const Mesh*, std::vector<std::uint32_t>> startsOfMesh;
  std::vector<const std::vector<std::uint32_t>*> starts;
  std::uint64_t facetCount = 0;
  for (const Object& object : scene.objects()) {
    auto [entry, fresh] = startsOfMesh.try_emplace(object.mesh.get());
    if (fresh) entry->second = facetStarts(*object.mesh);
    starts.push_back(&entry->second);
    firstFacet_.push_back(facetCount);
    facetCount += object.mesh->facetCount();
  }
  classOfFacet_.resize(facetCount);

  // Large facets first: they know their plane best, and the outcome does not depend on the order of the input.
  const glm::dvec3 center = scene.bounds().center();
  const double diagonal = scene.bounds().diagonal();
  const auto measured = [&](std::uint32_t object, std::uint32_t f) {
    Facet facet = measure(scene, object, f, rangeOf(*starts[object], f));
    facet.offset = diagonal > 0 ? glm::dot(facet.normal, facet.point - center) / diagonal : 0.0;
    facet.key.tie = planeHash(facet.normal, facet.offset);
    return facet;
  };
  std::vector<FacetKey> keys(facetCount);
  parallelFor(scene.objects().size(), 1, [&](std::size_t firstObject, std::size_t endObject) {
    for (std::size_t object = firstObject; object != endObject; ++object) {
      const std::size_t count = scene.objects()[object].mesh->facetCount();
      parallelFor(count, kBlock, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f != end; ++f) {
          keys[firstFacet_[object] + f] = measured(static_cast<std::uint32_t>(object), static_cast<std::uint32_t>(f)).key;
        }
      });
    }
  });
  parallelSort(keys.begin(), keys.end(), [](const FacetKey& a, const FacetKey& b) {
    return std::tuple(-a.area, a.tie, a.object, a.facet) < std::tuple(-b.area, b.tie, b.object, b.facet);
  });

  // Facets are measured again block by block, in parallel, rather than kept; the classes are formed in order.
  const double relative = diagonal > 0 ? tolerance_ / diagonal : kRelativeTolerance;
  ClassIndex index(relative * kMarginPerTolerance, facetCount);
  std::vector<Facet> block;
  for (std::size_t begin = 0; begin < keys.size(); begin += kBlock) {
    block.resize(std::min(kBlock, keys.size() - begin));
    parallelFor(block.size(), 64, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i != last; ++i) block[i] = measured(keys[begin + i].object, keys[begin + i].facet);
    });
    for (const Facet& facet : block) {
      std::uint32_t found = index.find(facet, [&](std::uint32_t c) { return agrees(scene, facet, classes_[c], *starts[facet.key.object], tolerance_); });
      if (found == ClassIndex::kEnd) {
        found = static_cast<std::uint32_t>(classes_.size());
        constexpr float kInf = std::numeric_limits<float>::infinity();
        classes_.push_back({facet.normal, above(facet.error), facet.key.object, facet.key.triangle, glm::vec3(kInf), glm::vec3(-kInf)});
        index.insert(facet, found);
      }
      widen(classes_[found], facet.box);
      classOfFacet_[firstFacet_[facet.key.object] + facet.key.facet] = found;
    }
  }
  keys = {};
  numberByObject();
}

// Classes numbered as the objects meet them, so that what is drawn together lies together.
void PlaneClasses::numberByObject() {
  std::vector<std::uint32_t> number(classes_.size(), ~std::uint32_t{0});
  std::uint32_t count = 0;
  for (std::uint32_t& planeClass : classOfFacet_) {
    if (number[planeClass] == ~std::uint32_t{0}) number[planeClass] = count++;
    planeClass = number[planeClass];
  }
  // Moved in place, cycle by cycle.
  for (std::uint32_t i = 0; i < number.size(); ++i) {
    while (number[i] != i) {
      std::swap(classes_[i], classes_[number[i]]);
      std::swap(number[i], number[number[i]]);
    }
  }
}

}  // namespace copeel
