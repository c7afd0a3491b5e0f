// Random CSG scenes on a coarse grid, where coincident faces are the rule, and the ways they are placed: as they are, turned as a whole, turned
// leaf by leaf (so that faces agree to rounding only), or moved far away. Deterministic from a seed on every machine.
//
// A scene is text as openscad would write it, with all digits, so the reader is judged along with the renderer.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>

#include "core/scene/view.h"
#include "validation/views.h"

namespace copeel::validation {

// Vigna's splitmix64: a counter and a mixing function; no standard distribution, whose numbers differ between libraries.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  int below(int count) { return int(next() % std::uint64_t(count)); }
  int between(int low, int high) { return low + below(high - low + 1); }       // both included
  double unit() { return double(next() >> 11) * 0x1p-53; }                      // 0 <= unit < 1

 private:
  std::uint64_t state_;
};

enum class Placement { Plain, TurnedWhole, TurnedLeafByLeaf, Moved };
inline constexpr Placement kPlacements[] = {Placement::Plain, Placement::TurnedWhole, Placement::TurnedLeafByLeaf, Placement::Moved};
std::string nameOf(Placement placement);

// One leaf on the grid: a shape of the .csg language and an exact placement (quarter turns and whole translations).
struct SceneLeaf {
  std::string shape;               // for example "cube(size = [1, 2, 3], center = false);"
  glm::dmat4 worldFromObject{1.0};
  std::vector<glm::dvec3> corners; // of boxes: as polyhedron vertices they may be turned one by one; else empty
};

struct RandomScene {
  std::uint64_t seed = 0;
  std::vector<SceneLeaf> leaves;
  std::string tree;                // the text with "@0;" … where the leaves go
  std::vector<Look> looks;         // three views in grid coordinates

  // The text of the scene placed in one of the ways; the intended solid is that of Plain moved by motion(placement).
  std::string text(Placement placement) const;
  glm::dmat4 motion(Placement placement) const;
  // The views move along with the scene.
  std::vector<View> views(Placement placement, int width, int height) const;
};

RandomScene randomScene(std::uint64_t seed, int maxLeafCount = 8);

// The same of leaves that no exact kernel takes: polyhedra with whole corners in any place, which cross themselves, wind twice or backwards, lie flat; one
// in five lacks a face.
RandomScene randomCrossingScene(std::uint64_t seed, int maxLeafCount = 5);

// `multmatrix([[…]]) ` with all digits.
std::string matrixText(const glm::dmat4& matrix);

// A turn about x, then y, then z, in degrees, as rotate([x, y, z]) means it.
glm::dmat4 turn(double x, double y, double z);
glm::dmat4 translation(const glm::dvec3& by);
Look moved(const Look& look, const glm::dmat4& motion);

}  // namespace copeel::validation
