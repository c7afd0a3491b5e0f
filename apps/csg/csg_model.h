// A CSG model: placed leaves and the trees over them. All trees are arrays in post-order, so that a nesting of 10,000 needs no recursion.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "core/scene/mesh.h"

namespace copeel::csg {

enum class Operation : std::uint8_t { Leaf, Union, Intersection, Difference };

struct Leaf {
  std::shared_ptr<const Mesh> mesh;         // shared by every leaf of the same shape
  glm::dmat4 worldFromObject{1.0};
  // sRGB and alpha, 0 … 1; what is unset, or a negative red, green or blue, the colour scheme decides.
  std::optional<glm::dvec4> color;
  bool isFlat = false;                      // a 2D shape: a slab to the eye, without height when the model is measured
};

// Children of node n are childIndices[firstChild … firstChild + childCount), each smaller than n. A Union or Intersection of no children
// and a Difference of none are empty; a Difference with one child is that child.
struct Node {
  Operation operation = Operation::Union;
  std::uint32_t leaf = 0;                   // Operation::Leaf only: index into leaves
  std::uint32_t firstChild = 0;
  std::uint32_t childCount = 0;
};

// openscad's colour of what carries #.
inline constexpr glm::dvec4 kHighlightColor(1, 81.0 / 255, 81.0 / 255, 128.0 / 255);

inline constexpr std::uint32_t kNoNode = ~std::uint32_t{0};

struct Model {
  std::vector<Leaf> leaves;                 // in tree order: the order in which the source names them
  std::vector<Node> nodes;                  // children before parents
  std::vector<std::uint32_t> childIndices;
  std::uint32_t root = kNoNode;             // kNoNode: an empty model
  std::vector<std::uint32_t> background;    // roots of what carries %, shown translucent, not part of the solid
  std::vector<std::uint32_t> highlight;     // roots of what carries #, part of the solid and shown translucent over it
  std::vector<std::string> warnings;        // one line each, for the user
};

}  // namespace copeel::csg
