// What is drawn: meshes, and the objects that place them. A mesh used by many objects is held once.
// A primitive is one triangle of one object; primitive ids run through the objects in order, 0 … primitiveCount-1.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/scene/box.h"
#include "core/scene/mesh.h"

namespace copeel {

struct Object {
  std::shared_ptr<const Mesh> mesh;
  glm::dmat4 worldFromObject{1.0};   // affine; a negative determinant mirrors and is honoured
};

// Ids from here on name the pieces of triangles that were clipped (core/cpu/projection.h).
inline constexpr std::uint32_t kPrimitiveLimit = 0xC0000000u;

// World coordinates beyond it (or not a number) are refused: what is computed of them would leave float and double.
inline constexpr double kLargestCoordinate = 1e30;

class Scene {
 public:
  Scene() = default;
  explicit Scene(std::vector<Object> objects);   // throws Error{Input}: kLargestCoordinate

  const std::vector<Object>& objects() const { return objects_; }
  std::uint32_t primitiveCount() const { return firstPrimitive_.back(); }
  std::uint32_t firstPrimitive(std::uint32_t object) const { return firstPrimitive_[object]; }
  std::uint32_t objectOf(std::uint32_t primitive) const;   // O(log objects)
  // The first of the objects up to this one that are, one after another, the same mesh in the same place.
  std::uint32_t originalOf(std::size_t object) const { return originals_[object]; }
  bool repeats(std::size_t object) const { return originals_[object] != object; }   // the object before
  glm::dvec3 worldVertex(std::uint32_t object, std::uint32_t vertex) const;
  const Box& bounds() const { return bounds_; }            // of all vertices used by triangles, world units

 private:
  std::vector<std::uint32_t> findOriginals() const;

  std::vector<Object> objects_;
  std::vector<std::uint32_t> firstPrimitive_{0};
  std::vector<std::uint32_t> originals_;
  Box bounds_;
};

// The world position of a vertex. One expression for the whole program: equal input, equal bits. Vectors make the same steps (place_vertices-inl.h,
// depth_planes-inl.h).
inline glm::dvec3 transformPoint(const glm::dmat4& m, const glm::dvec3& p) {
  return {m[0].x * p.x + m[1].x * p.y + m[2].x * p.z + m[3].x,
          m[0].y * p.x + m[1].y * p.y + m[2].y * p.z + m[3].y,
          m[0].z * p.x + m[1].z * p.y + m[2].z * p.z + m[3].z};
}

}  // namespace copeel
