// Scene: numbering of primitives and the world bounds.
#include "core/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "core/error.h"

namespace copeel {

namespace {

bool fits(const glm::dvec3& p) {
  return std::abs(p.x) <= kLargestCoordinate && std::abs(p.y) <= kLargestCoordinate && std::abs(p.z) <= kLargestCoordinate;
}

}  // namespace

Scene::Scene(std::vector<Object> objects) : objects_(std::move(objects)) {
  std::uint64_t count = 0;
  firstPrimitive_.reserve(objects_.size() + 1);
  std::unordered_map<const Mesh*, std::vector<std::uint8_t>> usedOfMesh;
  for (const Object& object : objects_) {
    const Mesh& mesh = *object.mesh;
    count += mesh.triangles.size();
    if (count >= kPrimitiveLimit) failMachine("the scene has more than {} triangles", kPrimitiveLimit);
    firstPrimitive_.push_back(static_cast<std::uint32_t>(count));
    // A vertex is placed once, however many triangles share it.
    auto [used, fresh] = usedOfMesh.try_emplace(&mesh);
    if (fresh) used->second = usedVertices(mesh);
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      if (!used->second[v]) continue;
      const glm::dvec3 p = transformPoint(object.worldFromObject, mesh.vertices[v]);
      if (!fits(p)) failInput("object {}: a corner at ({}, {}, {}); coordinates reach to 1e30", &object - objects_.data() + 1, p.x, p.y, p.z);
      bounds_.add(p);
    }
  }
  originals_ = findOriginals();
}

std::vector<std::uint32_t> Scene::findOriginals() const {
  std::vector<std::uint32_t> originals(objects_.size());
  for (std::uint32_t i = 0; i < originals.size(); ++i) {
    const bool repeats = i > 0 && objects_[i].mesh == objects_[i - 1].mesh && objects_[i].worldFromObject == objects_[i - 1].worldFromObject;
    originals[i] = repeats ? originals[i - 1] : i;
  }
  return originals;
}

std::uint32_t Scene::objectOf(std::uint32_t primitive) const {
  const auto next = std::upper_bound(firstPrimitive_.begin(), firstPrimitive_.end(), primitive);
  return static_cast<std::uint32_t>(next - firstPrimitive_.begin() - 1);
}

glm::dvec3 Scene::worldVertex(std::uint32_t object, std::uint32_t vertex) const {
  return transformPoint(objects_[object].worldFromObject, objects_[object].mesh->vertices[vertex]);
}

}  // namespace copeel
