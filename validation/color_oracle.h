// The colour a ray must show, unlit, by the rule of translucency: each entry into the result blends once with the alpha of the face that shows, front to
// back; leaving blends nothing; walls between solids of one union are not entries. What is opaque stays visible within what is translucent: the
// tree with the translucent leaves that add taken as empty shows its first entry behind.
#pragma once

#include <glm/vec3.hpp>

#include "validation/oracle.h"

namespace copeel::validation {

class ColorOracle {
 public:
  ColorOracle(const csg::Model& model, const View& view, const csg::ColorScheme& scheme = {});

  glm::dvec3 color(const Ray& ray) const;   // 0 … 255
  const CsgOracle& whole() const { return whole_; }

 private:
  std::vector<glm::dvec4> leafColors_;      // 0 … 255 and alpha, of the leaf's faces as they show
  glm::dvec3 background_;
  CsgOracle whole_, opaque_;
};

}  // namespace copeel::validation
