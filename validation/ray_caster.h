// Which triangles a pixel's ray crosses, in which order, without any doubt: a filter in double with proven bounds, and rationals where the
// bounds leave it open. Shares no code with the renderer.
//
// A ray that meets an edge or a vertex exactly is moved by (ε, ε²) pixels with ε → 0 (symbolic perturbation, Edelsbrunner and Mücke,
// Simulation of Simplicity, ACM ToG 1990): then it crosses each closed surface a consistent number of times. Depths are those of the
// ray that was not moved. Faces seen edge-on have no area in the image and are not crossed.
//
// Cost: triangles are kept in lists per tile of 16 × 16 pixels; one ray costs about 20 ns per triangle of its tile, and microseconds per
// question that needs rationals. Not for concurrent use: the rationals are made when first needed.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "core/scene/view.h"
#include "validation/oracle_mesh.h"
#include "validation/sight.h"

namespace copeel::validation {

struct Crossing {
  std::uint32_t mesh = 0;        // index into the meshes
  std::uint32_t triangle = 0;    // running through all meshes
  int winding = 0;               // +1: the ray enters, -1: it leaves
  Bounded depth;                 // along the view axis, model units
  mutable std::shared_ptr<const mpq_class> exactDepth;   // made when first needed
};

// A pixel's ray, in the coordinates of view.h.
struct Ray {
  double u = 0, v = 0;
};

class RayCaster {
 public:
  RayCaster(const std::vector<OracleMesh>& meshes, const View& view);

  const View& view() const { return view_; }
  // The ray of pixel (x, y), moved by some pixels.
  Ray rayOf(int x, int y, double du = 0, double dv = 0) const;

  // All crossings in front of the eye (perspective) or on the whole line (orthographic), nearest first; equal depths in order of triangle.
  std::vector<Crossing> cross(const Ray& ray) const;

  // Whether two crossings of one ray count as one depth: exactly equal, or one of the triangles lies within `tolerance` (model units) of the
  // other's plane.
  bool sameDepth(const Ray& ray, const Crossing& near, const Crossing& far, double tolerance) const;

  // The cosine between a ray and a triangle's normal, and the depth at which the ray meets the triangle's plane. In plain double.
  double cosine(const Ray& ray, std::uint32_t triangle) const;
  double planeDepth(const Ray& ray, std::uint32_t triangle) const;

  // Whether the projection of an edge of any triangle in front of the eye passes within `radius` pixels of the ray; edges inside a flat facet are none.
  bool nearEdge(const Ray& ray, double radius) const;

 private:
  struct Triangle {
    std::uint32_t mesh = 0;
    glm::uvec3 corners{0};
    std::array<bool, 3> sharp{true, true, true};   // edge i → i+1 is not inside a flat facet
    Sight<Bounded> sight;
    mutable std::unique_ptr<Sight<mpq_class>> exactSight;
    mutable std::optional<std::uint32_t> exactPlane;
  };

  void addTriangles(std::uint32_t mesh);
  void markFlatEdges(std::uint32_t mesh, std::size_t first);
  void addToTiles(std::uint32_t triangle);
  std::array<Vec<mpq_class>, 3> exactCorners(const Triangle& triangle) const;
  const Sight<mpq_class>& exactSight(const Triangle& triangle) const;
  std::uint32_t exactPlane(const Triangle& triangle) const;
  bool liesInPlaneOf(const Triangle& t, const Triangle& plane, double tolerance) const;
  std::optional<Crossing> crossTriangle(const Ray& ray, std::uint32_t index) const;
  std::optional<int> side(const Ray& ray, const Triangle& triangle, int edge) const;
  const mpq_class& exactDepth(const Ray& ray, const Crossing& crossing) const;
  int compareDepth(const Ray& ray, const Crossing& a, const Crossing& b) const;
  const std::vector<std::uint32_t>& tileOf(const Ray& ray) const;

  std::vector<OracleMesh> meshes_;
  View view_;
  std::vector<Triangle> triangles_;
  int tileColumns_ = 0, tileRows_ = 0;
  std::vector<std::vector<std::uint32_t>> tiles_;
  mutable std::map<std::array<mpq_class, 4>, std::uint32_t> planeNumbers_;
};

}  // namespace copeel::validation
