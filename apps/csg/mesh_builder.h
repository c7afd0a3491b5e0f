// Collects the polygon faces of a solid into a Mesh: each face is one facet.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/scene/mesh.h"

namespace copeel::csg {

class MeshBuilder {
 public:
  // A hint.
  void reserve(std::size_t vertices, std::size_t triangles) {
    mesh_.vertices.reserve(vertices);
    mesh_.triangles.reserve(triangles);
    mesh_.facets.reserve(triangles);
  }
  std::uint32_t addVertex(const glm::dvec3& position) {
    mesh_.vertices.push_back(position);
    return static_cast<std::uint32_t>(mesh_.vertices.size() - 1);
  }
  // A facet begins, and every triangle until the next one belongs to it.
  void beginFacet() { open_ = true; }
  void addTriangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (open_) ++facet_;
    open_ = false;
    mesh_.triangles.emplace_back(a, b, c);
    mesh_.facets.push_back(facet_);
  }
  void addTriangleFacet(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    beginFacet();
    addTriangle(a, b, c);
  }
  void addQuadFacet(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    addTriangleFacet(a, b, c);
    addTriangle(a, c, d);
  }
  // A convex face, counter-clockwise from outside: every second corner is cut off, again and again, so that no triangle is thinner
  // than the face demands (a fan of a circle is made of needles).
  void addConvexFacet(std::span<const std::uint32_t> corners) {
    beginFacet();
    const std::size_t n = corners.size();
    for (std::size_t step = 1; step < n; step *= 2) {
      for (std::size_t i = 0; i + step < n; i += 2 * step) {
        const std::size_t last = i + 2 * step < n ? i + 2 * step : 0;
        if (last != i) addTriangle(corners[i], corners[i + step], corners[last]);
      }
    }
  }
  const glm::dvec3& vertex(std::uint32_t index) const { return mesh_.vertices[index]; }
  std::shared_ptr<const Mesh> finish() { return std::make_shared<const Mesh>(std::move(mesh_)); }

 private:
  Mesh mesh_;
  std::uint32_t facet_ = ~std::uint32_t{0};   // the first facet becomes 0
  bool open_ = true;
};

}  // namespace copeel::csg
