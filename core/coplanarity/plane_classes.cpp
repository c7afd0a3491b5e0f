// Forms plane classes: most facets are alone, as no other's plane is near theirs, and are classes of their own. The others are sorted from large
// to small, each tried against the classes of the cells near it.
#include "core/coplanarity/plane_classes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <tuple>
#include <utility>

#include <glm/geometric.hpp>

#include "core/coplanarity/facets.h"
#include "core/coplanarity/plane_cells.h"
#include "core/parallel.h"

namespace copeel {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();
constexpr double kRelativeTolerance = 1e-10;   // of the diagonal, for double coordinates
constexpr double kFloatUlps = 4;               // for coordinates that came as float
constexpr double kDoubleUlps = 16;             // least tolerance: two products of matrices and a rounding each
// A facet of the size of a pixel (1e-3 of the scene) within the tolerance is turned by 1e3 tolerances at most: the margin of the cells.
constexpr double kMarginPerTolerance = 1e3;
constexpr std::size_t kGrain = 512;    // facets, for parallel loops
constexpr std::size_t kBlock = 8192;   // facets measured at a time
constexpr std::uint32_t kNone = ~std::uint32_t{0};

// The next float above, and below: what a double rounds to is passed, so that bounds stay bounds.
float above(double v) {
  const float f = static_cast<float>(v);
  if (!(f < std::numeric_limits<float>::infinity())) return f;
  if (f == 0) return std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<std::uint32_t>(f);
  return std::bit_cast<float>(f > 0 ? bits + 1 : bits - 1);
}
float below(double v) { return -above(-v); }

void widen(PlaneClass& planeClass, const Box& box) {
  for (int i = 0; i < 3; ++i) {
    if (box.min[i] < double(planeClass.boundsMin[i])) planeClass.boundsMin[i] = below(box.min[i]);
    if (box.max[i] > double(planeClass.boundsMax[i])) planeClass.boundsMax[i] = above(box.max[i]);
  }
}

PlaneClass classOfOne(const FacetPlane& plane, std::uint32_t object) {
  constexpr float kInf = std::numeric_limits<float>::infinity();
  PlaneClass result{plane.normal, above(plane.error), object, plane.triangle, glm::vec3(kInf), glm::vec3(-kInf)};
  widen(result, plane.box);
  return result;
}

double largestCoordinate(const Box& bounds) {
  if (bounds.empty()) return 0;
  const glm::dvec3 m = glm::max(glm::abs(bounds.min), glm::abs(bounds.max));
  return std::max({m.x, m.y, m.z});
}

// Facets of equal area fall in an order of geometry, not of input.
std::uint32_t tieOf(const glm::dvec3& normal, double offset) {
  std::uint64_t h = 0x9E3779B97F4A7C15ull;
  for (double v : {normal.x, normal.y, normal.z, offset}) h = (h ^ std::bit_cast<std::uint64_t>(v + 0.0)) * 0xD6E8FEB86659FD93ull, h ^= h >> 32;
  return static_cast<std::uint32_t>(h);
}

// What sorting needs of a facet. Large facets first: they know their plane best, and the outcome does not depend on the order of the input.
struct FacetKey {
  float area;
  std::uint32_t tie, facet;   // counted through all objects

  friend bool operator<(const FacetKey& a, const FacetKey& b) {
    return std::tuple(-a.area, a.tie, a.facet) < std::tuple(-b.area, b.tie, b.facet);
  }
};

// A facet that is to find its class.
struct Facet {
  PlaneClass alone;
  glm::dvec3 point{0};   // of its plane
  FacetExtent extent;
  FacetRange range{0, 0};
  PlaneCells::Place place = 0;
};

// Every corner within the tolerance of the class's plane. The plane of the facet and its extent mostly tell without looking at the corners.
bool agrees(const Scene& scene, const Facet& facet, const PlaneClass& planeClass, double tolerance) {
  const glm::dvec3 point = pointOf(scene, planeClass), normal = facet.alone.normal;
  const double at = std::abs(glm::dot(planeClass.normal, facet.point - point));
  if (at > tolerance) return false;
  const glm::dvec3 turn = glm::dot(normal, planeClass.normal) < 0 ? normal + planeClass.normal : normal - planeClass.normal;
  if (at + facet.extent.flatness + glm::length(turn) * facet.extent.radius <= tolerance) return true;
  const std::uint32_t object = facet.alone.object;
  const Mesh& mesh = *scene.objects()[object].mesh;
  for (std::uint32_t t = facet.range.begin; t < facet.range.end; ++t) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 v = scene.worldVertex(object, mesh.triangles[t][k]);
      if (std::abs(glm::dot(planeClass.normal, v - point)) > tolerance) return false;
    }
  }
  return true;
}

// Classes by cell. A bucket of the table holds the cells that hash to it; chains are threaded through `chain_`.
class ClassIndex {
 public:
  explicit ClassIndex(std::size_t expected) : heads_(std::bit_ceil(expected * 2 + 1), kNone) {}

  void insert(std::uint64_t cell, std::uint32_t planeClass) {
    chain_.resize(planeClass + 1);
    chain_[planeClass] = {std::exchange(heads_[bucketOf(cell)], planeClass), checkOf(cell)};
  }

  // The first class for which `accept` holds among those whose plane may agree; kNone if none.
  template <class Accept>
  std::uint32_t find(PlaneCells::Place place, Accept accept) const {
    std::uint32_t found = kNone;
    PlaneCells::anyNear(place, [&](std::uint64_t cell) {
      for (found = heads_[bucketOf(cell)]; found != kNone; found = chain_[found].next) {
        if (chain_[found].check == checkOf(cell) && accept(found)) return true;
      }
      return false;
    });
    return found;
  }

 private:
  struct Link {
    std::uint32_t next;
    std::uint32_t check;   // most classes of other cells in the bucket are passed over unseen
  };
  static std::uint32_t checkOf(std::uint64_t cell) { return static_cast<std::uint32_t>(mixed(cell) >> 32); }
  std::size_t bucketOf(std::uint64_t cell) const { return mixed(cell) & (heads_.size() - 1); }

  std::vector<std::uint32_t> heads_;
  std::vector<Link> chain_;
};

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

// Measures facets and forms classes of those that are in reach of each other.
class PlaneClasses::Former {
 public:
  Former(const Scene& scene, double tolerance, const std::vector<std::uint64_t>& firstFacet)
      : scene_(scene),
        tolerance_(tolerance),
        center_(scene.bounds().center()),
        diagonal_(scene.bounds().diagonal()),
        cells_((diagonal_ > 0 ? tolerance / diagonal_ : kRelativeTolerance) * kMarginPerTolerance),
        firstFacet_(firstFacet) {}

  // Each facet as a class of its own, and where its plane lies.
  void measureAll(PlaneClass* classes, std::vector<PlaneCells::Place>& places) const {
    parallelFor(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      std::uint32_t object = objectOf(begin);
      FacetRange range = rangeOf(meshOf(object), facetOf(object, begin));
      for (std::size_t i = begin; i != end; ++i) {
        const FacetPlane plane = planeOf(scene_.objects()[object], range);
        classes[i] = classOfOne(plane, object);
        places[i] = cells_.placeOf(plane.normal, offsetOf(plane.normal, plane.point));
        if (i + 1 == end) break;
        if (i + 1 == firstFacet_[object + 1]) object = objectOf(i + 1), range.end = 0;
        range = rangeFrom(meshOf(object), range.end, facetOf(object, i + 1));
      }
    });
  }

  // The keys of these facets, sorted. `alone`: the classes that measureAll made.
  std::vector<FacetKey> keysOf(const std::vector<std::uint32_t>& facets, const PlaneClass* alone) const {
    std::vector<FacetKey> keys(facets.size());
    parallelFor(keys.size(), kGrain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i != end; ++i) {
        const PlaneClass& facet = alone[facets[i]];
        const double area = doubledArea(scene_.objects()[facet.object], facet.triangle);
        keys[i] = {static_cast<float>(area), tieOf(facet.normal, offsetOf(facet.normal, pointOf(scene_, facet))), facets[i]};
      }
    });
    parallelSort(keys.begin(), keys.end(), std::less<>());
    return keys;
  }

  // Classes in the order of their representatives, as the facets that these are; each is widened where measureAll put it. Extents are measured block
  // by block, in parallel, rather than kept; the classes are formed in order. Calls assign(facet, class) for each.
  template <class Assign>
  std::vector<std::uint32_t> form(const std::vector<FacetKey>& keys, PlaneClass* alone, Assign assign) const {
    std::vector<std::uint32_t> representatives;
    ClassIndex index(keys.size());
    std::vector<Facet> block;
    for (std::size_t begin = 0; begin < keys.size(); begin += kBlock) {
      block.resize(std::min(kBlock, keys.size() - begin));
      parallelFor(block.size(), 64, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i != last; ++i) block[i] = measured(keys[begin + i].facet, alone);
      });
      for (std::size_t i = 0; i < block.size(); ++i) {
        const Facet& facet = block[i];
        std::uint32_t found =
            index.find(facet.place, [&](std::uint32_t c) { return agrees(scene_, facet, alone[representatives[c]], tolerance_); });
        if (found == kNone) {
          found = static_cast<std::uint32_t>(representatives.size());
          representatives.push_back(keys[begin + i].facet);
          index.insert(PlaneCells::homeOf(facet.place), found);
        } else {
          widen(alone[representatives[found]], facet.extent.box);
        }
        assign(keys[begin + i].facet, found);
      }
    }
    return representatives;
  }

 private:
  const Mesh& meshOf(std::uint32_t object) const { return *scene_.objects()[object].mesh; }
  // Of a facet counted through all objects.
  std::uint32_t objectOf(std::size_t facet) const {
    return static_cast<std::uint32_t>(std::upper_bound(firstFacet_.begin(), firstFacet_.end(), facet) - firstFacet_.begin() - 1);
  }
  std::uint32_t facetOf(std::uint32_t object, std::size_t facet) const { return static_cast<std::uint32_t>(facet - firstFacet_[object]); }

  // Of the plane from the scene's centre, in diagonals.
  double offsetOf(const glm::dvec3& normal, const glm::dvec3& point) const {
    return diagonal_ > 0 ? glm::dot(normal, point - center_) / diagonal_ : 0.0;
  }
  Facet measured(std::size_t index, const PlaneClass* alone) const {
    Facet facet;
    facet.alone = alone[index];
    facet.point = pointOf(scene_, facet.alone);
    const Object& object = scene_.objects()[facet.alone.object];
    facet.range = rangeOf(*object.mesh, facetOf(facet.alone.object, index));
    facet.extent = extentOf(object, facet.range, facet.alone.normal, facet.point);
    facet.place = cells_.placeOf(facet.alone.normal, offsetOf(facet.alone.normal, facet.point));
    return facet;
  }

  const Scene& scene_;
  double tolerance_;
  glm::dvec3 center_;
  double diagonal_;
  PlaneCells cells_;
  const std::vector<std::uint64_t>& firstFacet_;   // of each object, and the end
};

PlaneClasses::PlaneClasses(const Scene& scene, double tolerance)
    : tolerance_(tolerance > 0 ? tolerance : defaultCoplanarTolerance(scene)) {
  std::vector<std::uint64_t> firstFacet{0};   // of each object, and the end
  for (const Object& object : scene.objects()) firstFacet.push_back(firstFacet.back() + object.mesh->facetCount());
  const std::size_t facetCount = firstFacet.back();
  classOfFacet_.assign(facetCount, kNone);
  room_ = std::make_unique_for_overwrite<std::byte[]>(facetCount * sizeof(PlaneClass) + sizeof(PlaneClassGroup));
  auto* const ofFacets = reinterpret_cast<PlaneClass*>(room_.get());

  const Former former(scene, tolerance_, firstFacet);
  std::vector<std::uint32_t> inReach;
  {
    std::vector<PlaneCells::Place> places(facetCount);
    former.measureAll(ofFacets, places);
    inReach = placesInReach(places);
  }
  const std::vector<std::uint32_t> representatives =
      former.form(former.keysOf(inReach, ofFacets), ofFacets,
                  [&](std::uint32_t facet, std::uint32_t planeClass) { classOfFacet_[facet] = planeClass; });
  numberByObject(ofFacets, representatives);
  shareLists(scene, firstFacet);
}

// A mesh placed again where the object before has it mostly has its classes too: frames that meet both find them in the caches if they are there once.
void PlaneClasses::shareLists(const Scene& scene, const std::vector<std::uint64_t>& firstFacet) {
  std::uint32_t* const all = classOfFacet_.data();
  std::uint32_t* kept = all;
  for (std::size_t i = 0; i < scene.objects().size(); ++i) {
    const std::uint32_t *const begin = all + firstFacet[i], *const end = all + firstFacet[i + 1];
    const bool shares = scene.repeats(i) && std::equal(begin, end, all + firstClass_.back());
    firstClass_.push_back(shares ? firstClass_.back() : static_cast<std::uint64_t>(kept - all));
    if (shares) continue;
    if (kept != begin) std::copy(begin, end, kept);
    kept += end - begin;
  }
  classOfFacet_.resize(static_cast<std::size_t>(kept - all));
}

// Classes numbered as the objects meet them, so that what is drawn together lies together. Each moves down to its place in the same room: a
// representative is never before the first facet of its class, so nothing is overwritten that is still wanted.
void PlaneClasses::numberByObject(const PlaneClass* ofFacets, const std::vector<std::uint32_t>& representatives) {
  static_assert(sizeof(PlaneClassGroup) <= PlaneClassGroup::kSize * sizeof(PlaneClass));
  constexpr std::size_t kSize = PlaneClassGroup::kSize;
  PlaneClassGroup group{};
  const auto store = [&] { std::memcpy(room_.get() + (classCount_ - 1) / kSize * sizeof(group), &group, sizeof(group)); };
  std::vector<std::uint32_t> number(representatives.size(), kNone);
  for (std::size_t facet = 0; facet < classOfFacet_.size(); ++facet) {
    std::uint32_t& planeClass = classOfFacet_[facet];
    const bool isAlone = planeClass == kNone;
    if (!isAlone && number[planeClass] != kNone) {
      planeClass = number[planeClass];
      continue;
    }
    group.set(classCount_ % kSize, ofFacets[isAlone ? facet : representatives[planeClass]]);
    if (!isAlone) number[planeClass] = classCount_;
    planeClass = classCount_++;
    if (classCount_ % kSize == 0) store();
  }
  if (classCount_ % kSize != 0) store();
}

}  // namespace copeel
