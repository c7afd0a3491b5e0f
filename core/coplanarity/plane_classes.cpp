// Forms plane classes: facets sorted from large to small, each tried against the classes that a hash of (normal, offset) finds near it.
#include "core/coplanarity/plane_classes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <unordered_map>

#include <glm/geometric.hpp>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

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

struct Facet {
  double area = 0;              // of its largest triangle, doubled
  glm::dvec3 normal{0, 0, 1};   // unit, turned into the half-space of kHalf
  double offset = 0;            // of the plane from the scene's centre, in diagonals
  float normalError = 0;
  std::uint32_t object = 0, facet = 0, triangle = 0;
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

// Plane and its error bound from the facet's largest triangle.
void measure(const Scene& scene, Facet& facet, FacetRange range, const glm::dvec3& center, double diagonal) {
  glm::dvec3 p{0}, sum{0};
  double best = -1, magnitude = 0;
  for (std::uint32_t t = range.begin; t < range.end; ++t) {
    const glm::uvec3 v = scene.objects()[facet.object].mesh->triangles[t];
    const glm::dvec3 a = scene.worldVertex(facet.object, v.x);
    const glm::dvec3 e = scene.worldVertex(facet.object, v.y) - a;
    const glm::dvec3 f = scene.worldVertex(facet.object, v.z) - a;
    const glm::dvec3 n = glm::cross(e, f);
    const double area = glm::length(n);
    if (!(area > best)) continue;
    best = area, p = a, sum = n, facet.triangle = t;
    magnitude = glm::length(e) * glm::length(f);
  }
  facet.area = best;
  // Each component of the cross product carries four roundings of products no larger than |e||f|.
  const double error = best > 0 ? 8 * kEps * magnitude / best : 1.0;
  if (error < 0.25) {
    facet.normal = sum / best;
  } else {
    const glm::uvec3 v = scene.objects()[facet.object].mesh->triangles[facet.triangle];
    facet.normal = needleNormal(p, scene.worldVertex(facet.object, v.y), scene.worldVertex(facet.object, v.z));
  }
  if (glm::dot(facet.normal, kHalf) < 0) facet.normal = -facet.normal;
  facet.normalError = static_cast<float>(std::min(error * 1.001 + 4 * kEps, 1.0));
  facet.offset = diagonal > 0 ? glm::dot(facet.normal, p - center) / diagonal : 0.0;
}

using Cell = std::array<std::int64_t, 4>;
struct CellHash {
  std::size_t operator()(const Cell& c) const {
    std::uint64_t h = 0x9E3779B97F4A7C15ull;
    for (std::int64_t v : c) h = (h ^ static_cast<std::uint64_t>(v)) * 0xD6E8FEB86659FD93ull, h ^= h >> 32;
    return h;
  }
};

// Classes by cell of (normal, offset). Chains are threaded through `next`, so that a cell costs one map entry.
class ClassIndex {
 public:
  ClassIndex(double margin, std::size_t expected) : cell_(std::min(margin * kCellPerMargin, kLargestCell)), margin_(margin / cell_) {
    heads_.reserve(expected);
  }

  void insert(const Facet& facet, std::uint32_t planeClass) {
    if (next_.size() <= planeClass) next_.resize(planeClass + 1, kEnd);
    auto [head, fresh] = heads_.try_emplace(cellOf(facet.normal, facet.offset), planeClass);
    if (!fresh) next_[planeClass] = std::exchange(head->second, planeClass);
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
  Cell cellOf(const glm::dvec3& n, double offset) const {
    return {std::llround(n.x / cell_), std::llround(n.y / cell_), std::llround(n.z / cell_), std::llround(offset / cell_)};
  }

  template <class Accept>
  std::uint32_t search(const glm::dvec3& n, double offset, Accept accept) const {
    const double at[4] = {n.x / cell_, n.y / cell_, n.z / cell_, offset / cell_};
    const Cell home = cellOf(n, offset);
    // A coordinate within the margin of its cell's border may have its class next door.
    std::int64_t step[4];
    for (int i = 0; i < 4; ++i) {
      const double inside = at[i] - static_cast<double>(home[i]);
      step[i] = inside > 0.5 - margin_ ? 1 : inside < -0.5 + margin_ ? -1 : 0;
    }
    for (int corner = 0; corner < 16; ++corner) {
      Cell cell = home;
      bool real = true;
      for (int i = 0; i < 4; ++i) {
        if (!(corner >> i & 1)) continue;
        if (step[i] == 0) real = false;
        cell[i] += step[i];
      }
      if (!real) continue;
      const auto head = heads_.find(cell);
      if (head == heads_.end()) continue;
      for (std::uint32_t c = head->second; c != kEnd; c = next_[c]) {
        if (accept(c)) return c;
      }
    }
    return kEnd;
  }

  double cell_, margin_;   // margin in cells
  std::unordered_map<Cell, std::uint32_t, CellHash> heads_;
  std::vector<std::uint32_t> next_;
};

float below(double v) { return std::nextafter(static_cast<float>(v), -std::numeric_limits<float>::infinity()); }
float above(double v) { return std::nextafter(static_cast<float>(v), std::numeric_limits<float>::infinity()); }

void widen(PlaneClass& planeClass, const glm::dvec3& point) {
  for (int i = 0; i < 3; ++i) {
    planeClass.boundsMin[i] = std::min(planeClass.boundsMin[i], below(point[i]));
    planeClass.boundsMax[i] = std::max(planeClass.boundsMax[i], above(point[i]));
  }
}

double largestCoordinate(const Box& bounds) {
  if (bounds.empty()) return 0;
  const glm::dvec3 m = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return std::max({m.x, m.y, m.z});
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

  // Measure every placed facet.
  const glm::dvec3 center = scene.bounds().center();
  const double diagonal = scene.bounds().diagonal();
  std::vector<Facet> facets(facetCount);
  tbb::parallel_for(std::size_t{0}, scene.objects().size(), [&](std::size_t object) {
    const auto count = static_cast<std::uint32_t>(scene.objects()[object].mesh->facetCount());
    for (std::uint32_t f = 0; f < count; ++f) {
      Facet& facet = facets[firstFacet_[object] + f];
      facet.object = static_cast<std::uint32_t>(object);
      facet.facet = f;
      measure(scene, facet, rangeOf(*starts[object], f), center, diagonal);
    }
  });

  // Large facets first: they know their plane best, and the outcome does not depend on the order of the input.
  tbb::parallel_sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) {
    const auto key = [](const Facet& f) {
      return std::tuple(-f.area, f.normal.x, f.normal.y, f.normal.z, f.offset, f.object, f.facet);
    };
    return key(a) < key(b);
  });

  const double relative = diagonal > 0 ? tolerance_ / diagonal : kRelativeTolerance;
  ClassIndex index(relative * kMarginPerTolerance, facetCount);
  std::vector<glm::dvec3> corners;
  for (const Facet& facet : facets) {
    const Mesh& mesh = *scene.objects()[facet.object].mesh;
    const FacetRange range = rangeOf(*starts[facet.object], facet.facet);
    corners.clear();
    for (std::uint32_t t = range.begin; t < range.end; ++t) {
      for (int k = 0; k < 3; ++k) corners.push_back(scene.worldVertex(facet.object, mesh.triangles[t][k]));
    }
    const auto agrees = [&](std::uint32_t c) {
      const PlaneClass& planeClass = classes_[c];
      const glm::dvec3 p = scene.worldVertex(
          planeClass.object, scene.objects()[planeClass.object].mesh->triangles[planeClass.triangle].x);
      return std::all_of(corners.begin(), corners.end(), [&](const glm::dvec3& v) {
        return std::abs(glm::dot(planeClass.normal, v - p)) <= tolerance_;
      });
    };
    std::uint32_t found = index.find(facet, agrees);
    if (found == ClassIndex::kEnd) {
      found = static_cast<std::uint32_t>(classes_.size());
      constexpr float kInf = std::numeric_limits<float>::infinity();
      classes_.push_back({facet.normal, facet.normalError, facet.object, facet.triangle, glm::vec3(kInf), glm::vec3(-kInf)});
      index.insert(facet, found);
    }
    for (const glm::dvec3& v : corners) widen(classes_[found], v);
    classOfFacet_[firstFacet_[facet.object] + facet.facet] = found;
  }
}

}  // namespace copeel
