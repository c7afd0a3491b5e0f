#include "apps/csg/arguments.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "apps/csg/color_names.h"
#include "apps/csg/restore_matrix.h"

namespace copeel::csg {
namespace {

template <class Point>
std::vector<Point> pointsOf(const SyntaxTree& tree, const Value& list) {
  if (list.kind != ValueKind::Vector) tree.fail(list.textBegin, "points is no list");
  std::vector<Point> result;
  result.reserve(list.itemCount());
  std::size_t at = static_cast<std::size_t>(&list - tree.tape.data()) + 1;
  for (std::uint32_t i = 0; i < list.itemCount(); ++i, at = tree.next(at)) {
    const Value& item = tree.tape[at];
    Point point(0.0);
    constexpr auto kDimension = static_cast<std::uint32_t>(Point::length());
    bool good = item.kind == ValueKind::Vector && (item.itemCount() == kDimension || (kDimension == 3 && item.itemCount() == 2));
    for (std::uint32_t k = 0; good && k < item.itemCount(); ++k) {
      const Value& number = tree.tape[at + 1 + k];
      point[static_cast<int>(k)] = number.number;
      good = number.kind == ValueKind::Number && std::isfinite(number.number);
    }
    if (!good) tree.fail(item.textBegin, fmt::format("point {} is not {} finite numbers", i, Point::length()));
    result.push_back(point);
  }
  return result;
}

}  // namespace

double numberOr(const SyntaxTree& tree, const SyntaxNode& node, std::string_view name, double otherwise, int position) {
  const Value* value = tree.find(node, name, position);
  return value && value->kind == ValueKind::Number ? value->number : otherwise;
}

bool boolOr(const SyntaxTree& tree, const SyntaxNode& node, std::string_view name, bool otherwise) {
  const Value* value = tree.find(node, name);
  return value && value->kind == ValueKind::Bool ? value->number != 0 : otherwise;
}

bool readNumbers(const SyntaxTree& tree, const Value& value, double* result, std::uint32_t count) {
  if (value.kind == ValueKind::Number) {
    for (std::uint32_t i = 0; i < count; ++i) result[i] = value.number;
    return true;
  }
  if (value.kind != ValueKind::Vector) return false;
  std::size_t at = static_cast<std::size_t>(&value - tree.tape.data()) + 1;
  for (std::uint32_t i = 0; i < value.itemCount() && i < count; ++i, at = tree.next(at)) {
    if (tree.tape[at].kind != ValueKind::Number) return false;
    result[i] = tree.tape[at].number;
  }
  return value.itemCount() > 0;
}

Fragments fragmentsOf(const SyntaxTree& tree, const SyntaxNode& node) {
  Fragments fragments;
  fragments.fn = numberOr(tree, node, "$fn", fragments.fn);
  fragments.fa = numberOr(tree, node, "$fa", fragments.fa);
  fragments.fs = numberOr(tree, node, "$fs", fragments.fs);
  return fragments;
}

double radiusOf(const SyntaxTree& tree, const SyntaxNode& node, std::string_view radius, std::string_view diameter, double otherwise) {
  return numberOr(tree, node, diameter, 2 * numberOr(tree, node, radius, otherwise)) / 2;
}

glm::dmat4 matrixOf(const SyntaxTree& tree, const SyntaxNode& node) {
  glm::dmat4 matrix(1.0);
  const Value* rows = tree.find(node, "m", 0);
  if (!rows || rows->kind != ValueKind::Vector) return matrix;
  MatrixTexts texts{};
  std::size_t row = static_cast<std::size_t>(rows - tree.tape.data()) + 1;
  for (int r = 0; r < 4 && r < static_cast<int>(rows->itemCount()); ++r, row = tree.next(row)) {
    if (tree.tape[row].kind != ValueKind::Vector) tree.fail(tree.tape[row].textBegin, "a row of the matrix is no list");
    std::size_t at = row + 1;
    for (int c = 0; c < 4 && c < static_cast<int>(tree.tape[row].itemCount()); ++c, at = tree.next(at)) {
      const Value& entry = tree.tape[at];
      if (entry.kind != ValueKind::Number) tree.fail(entry.textBegin, "an entry of the matrix is no number");
      matrix[c][r] = entry.number;
      texts[static_cast<std::size_t>(4 * r + c)] = tree.textOf(entry);
    }
  }
  // openscad divides by the last entry and has no use for the rest of the last row.
  if (matrix[3][3] != 1.0) {
    const double w = matrix[3][3];
    for (int c = 0; c < 4; ++c) matrix[c] /= w;
    texts = {};
  }
  matrix[0].w = matrix[1].w = matrix[2].w = 0;
  matrix[3].w = 1;
  return restoreMatrix(matrix, texts);
}

glm::dvec4 colorOf(const SyntaxTree& tree, const SyntaxNode& node) {
  const Value* value = tree.find(node, "c", 0);
  const double alpha = numberOr(tree, node, "alpha", -1, 1);
  if (value && value->kind == ValueKind::String) {
    const std::string name = tree.stringOf(*value);
    std::optional<glm::dvec4> color = namedColor(name);
    if (!color) tree.fail(value->textBegin, fmt::format("unknown colour '{}'", name));
    if (alpha >= 0) color->w = std::min(alpha, 1.0);
    return *color;
  }
  std::array<double, 4> rgba{-1, -1, -1, alpha};
  if (value && value->kind == ValueKind::Vector) readNumbers(tree, *value, rgba.data(), 4);
  glm::dvec4 color(-1, -1, -1, 1);
  for (int i = 0; i < 4; ++i) {
    const double component = rgba[static_cast<std::size_t>(i)];
    if (component >= 0) color[i] = std::min(component, 1.0);
  }
  return color;
}

std::vector<glm::dvec2> points2Of(const SyntaxTree& tree, const Value& points) { return pointsOf<glm::dvec2>(tree, points); }
std::vector<glm::dvec3> points3Of(const SyntaxTree& tree, const Value& points) { return pointsOf<glm::dvec3>(tree, points); }

IndexLists indexListsOf(const SyntaxTree& tree, const Value& lists, std::size_t pointCount, std::string_view what) {
  IndexLists result;
  if (lists.kind != ValueKind::Vector) tree.fail(lists.textBegin, fmt::format("{}s is no list", what));
  std::size_t list = static_cast<std::size_t>(&lists - tree.tape.data()) + 1;
  result.ends.reserve(lists.itemCount());
  result.indices.reserve(tree.next(list - 1) - list - lists.itemCount());
  for (std::uint32_t i = 0; i < lists.itemCount(); ++i, list = tree.next(list)) {
    if (tree.tape[list].kind != ValueKind::Vector) tree.fail(tree.tape[list].textBegin, fmt::format("{} {} is no list", what, i));
    std::size_t at = list + 1;
    for (std::uint32_t k = 0; k < tree.tape[list].itemCount(); ++k, at = tree.next(at)) {
      const Value& index = tree.tape[at];
      const bool good = index.kind == ValueKind::Number && index.number >= 0 && index.number < static_cast<double>(pointCount);
      if (!good) {
        tree.fail(index.textBegin, fmt::format("{} {} names point {}, but there are {} points", what, i, tree.textOf(index), pointCount));
      }
      result.indices.push_back(static_cast<std::uint32_t>(index.number));
    }
    result.ends.push_back(static_cast<std::uint32_t>(result.indices.size()));
  }
  return result;
}

}  // namespace copeel::csg
