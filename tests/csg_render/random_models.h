// Random trees of boxes on a coarse grid, where coincident faces are the rule. rapidcheck supplies the choices.
#pragma once

#include <rapidcheck.h>

#include "tests/support/models.h"
#include "tests/support/views.h"

namespace copeel::test {

inline Tree randomBox() {
  glm::dvec3 lo, hi;
  for (int axis = 0; axis < 3; ++axis) {
    const int a = *rc::gen::inRange(0, 4), b = *rc::gen::inRange(1, 4);
    lo[axis] = a, hi[axis] = a + b;
  }
  return leaf(box(lo, hi, *rc::gen::arbitrary<bool>()));
}

inline Tree randomTree(int depth) {
  if (depth == 0 || *rc::gen::inRange(0, 4) == 0) return randomBox();
  Tree tree;
  constexpr csg::Operation kOperations[] = {csg::Operation::Union, csg::Operation::Intersection, csg::Operation::Difference};
  tree.operation = kOperations[*rc::gen::inRange(0, 3)];
  const int children = *rc::gen::inRange(1, 4);
  for (int i = 0; i < children; ++i) tree.children.push_back(randomTree(depth - 1));
  return tree;
}

// Around the grid of randomBox, off its symmetries.
inline View randomView(int width, int height) {
  const double azimuth = *rc::gen::inRange(0, 360) + 0.123, elevation = *rc::gen::inRange(-80, 80) + 0.217;
  const bool perspective = *rc::gen::arbitrary<bool>();
  const glm::dvec3 center(3.51, 3.52, 3.53);
  const glm::dvec3 away(std::cos(radians(azimuth)) * std::cos(radians(elevation)), std::sin(radians(azimuth)) * std::cos(radians(elevation)),
                        std::sin(radians(elevation)));
  const double distance = *rc::gen::inRange(12, 40);
  return lookAt(center + away * distance, center, width, height, (perspective ? 10.0 / distance : 10.0) / std::min(width, height), perspective);
}

}  // namespace copeel::test
