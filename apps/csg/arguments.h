// The arguments of a node as numbers, with openscad's habits: what is missing or of another type keeps its default.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "apps/csg/csg_syntax.h"
#include "apps/csg/solids.h"

namespace copeel::csg {

double numberOr(const SyntaxTree& tree, const SyntaxNode& node, std::string_view name, double otherwise, int position = -1);
bool boolOr(const SyntaxTree& tree, const SyntaxNode& node, std::string_view name, bool otherwise);

// A vector of `count` numbers (the rest of `result` is kept), or a single number for all of them. False: neither.
bool readNumbers(const SyntaxTree& tree, const Value& value, double* result, std::uint32_t count);

Fragments fragmentsOf(const SyntaxTree& tree, const SyntaxNode& node);
double radiusOf(const SyntaxTree& tree, const SyntaxNode& node, std::string_view radius, std::string_view diameter, double otherwise);

// The matrix of a multmatrix, its rotation restored where six digits took it (see restore_matrix.h). Missing rows are the identity's.
glm::dmat4 matrixOf(const SyntaxTree& tree, const SyntaxNode& node);

// Red, green and blue are negative where the node leaves them open.
glm::dvec4 colorOf(const SyntaxTree& tree, const SyntaxNode& node);

// Points in 2 or 3 coordinates; fails with a line on anything else, NaN and infinities.
std::vector<glm::dvec2> points2Of(const SyntaxTree& tree, const Value& points);
std::vector<glm::dvec3> points3Of(const SyntaxTree& tree, const Value& points);

// A list of lists of indices below pointCount: the indices in a row, and where each list ends.
struct IndexLists {
  std::vector<std::uint32_t> indices;
  std::vector<std::uint32_t> ends;
};
IndexLists indexListsOf(const SyntaxTree& tree, const Value& lists, std::size_t pointCount, std::string_view what);

}  // namespace copeel::csg
