// Plane classes: which faces lie in one plane, decided once per scene and by identity, so that no rounding can part them later.
//
// A facet joins a class when every one of its vertices lies within the tolerance of the plane of the class's representative: the largest
// facet of the class, never a neighbour (a finely tessellated sphere would flow together into one plane). One plane seen from both
// sides is one class. A facet whose plane no other comes near is not asked. Cost: O(facets), O(n log n) for those that are; 68 bytes a facet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "core/scene/scene.h"

namespace copeel {

struct PlaneClass {
  glm::dvec3 normal;               // unit, of the representative, as it is turned
  float normalError;               // bound of |normal - true normal|
  std::uint32_t object;            // the representative triangle: its three world vertices, as doubles, are the true plane
  std::uint32_t triangle;          // within the object
  glm::vec3 boundsMin, boundsMax;  // of all faces of the class, world units, rounded outwards
};

// Eight classes, field by field, as vectors take them.
struct PlaneClassGroup {
  static constexpr std::size_t kSize = 8;
  double normal[3][kSize];
  float boundsMin[3][kSize], boundsMax[3][kSize], normalError[kSize];
  std::uint32_t object[kSize], triangle[kSize];

  PlaneClass get(std::size_t i) const {
    return {{normal[0][i], normal[1][i], normal[2][i]}, normalError[i], object[i], triangle[i],
            {boundsMin[0][i], boundsMin[1][i], boundsMin[2][i]}, {boundsMax[0][i], boundsMax[1][i], boundsMax[2][i]}};
  }
  void set(std::size_t i, const PlaneClass& from) {
    for (int k = 0; k < 3; ++k) normal[k][i] = from.normal[k], boundsMin[k][i] = from.boundsMin[k], boundsMax[k][i] = from.boundsMax[k];
    normalError[i] = from.normalError, object[i] = from.object, triangle[i] = from.triangle;
  }
};

// All classes of a scene, by number.
class PlaneClassList {
 public:
  PlaneClassList(const PlaneClassGroup* groups, std::size_t size) : groups_(groups), size_(size) {}

  std::size_t size() const { return size_; }
  PlaneClass operator[](std::size_t i) const { return groups_[i / PlaneClassGroup::kSize].get(i % PlaneClassGroup::kSize); }
  const PlaneClassGroup* groups() const { return groups_; }   // what the last one has beyond the last class is undefined

 private:
  const PlaneClassGroup* groups_;
  std::size_t size_;
};

// The representative's first vertex, world units.
inline glm::dvec3 pointOf(const Scene& scene, const PlaneClass& planeClass) {
  return scene.worldVertex(planeClass.object, scene.objects()[planeClass.object].mesh->triangles[planeClass.triangle].x);
}

// Tolerances are distances in world units.
//   double: 1e-10 of the scene's diagonal: rounding at 1e-15 merges, a film of 1e-6 stays
//   float:  4 ulp of the largest coordinate
// and never less than 16 ulp (double) of the largest coordinate, below which a turned vertex does not find its plane again.
double defaultCoplanarTolerance(const Scene& scene);

class PlaneClasses {
 public:
  PlaneClasses() = default;
  PlaneClasses(const Scene& scene, double tolerance);   // tolerance 0: the default

  double tolerance() const { return tolerance_; }
  PlaneClassList classes() const { return {reinterpret_cast<const PlaneClassGroup*>(room_.get()), classCount_}; }
  std::uint32_t classOf(std::uint32_t object, std::uint32_t facet) const { return classesOfObject(object)[facet]; }
  const std::uint32_t* classesOfObject(std::uint32_t object) const { return classOfFacet_.data() + firstClass_[object]; }

 private:
  class Former;
  void numberByObject(const PlaneClass* ofFacets, const std::vector<std::uint32_t>& representatives);
  void shareLists(const Scene& scene, const std::vector<std::uint64_t>& firstFacet);

  double tolerance_ = 0;
  std::unique_ptr<std::byte[]> room_;       // first for a PlaneClass of each facet, then for the groups of the classes
  std::uint32_t classCount_ = 0;
  std::vector<std::uint64_t> firstClass_;   // of each object, into classOfFacet_
  std::vector<std::uint32_t> classOfFacet_;
};

}  // namespace copeel
