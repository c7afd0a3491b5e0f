#include "apps/csg/flat.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include <clipper.hpp>
#include <fmt/format.h>

#include "apps/csg/arguments.h"
#include "apps/csg/shapes.h"
#include "apps/csg/solids.h"
#include "apps/csg/triangulate.h"

namespace copeel::csg {
namespace {

namespace clip = ClipperLib;

constexpr double kGrid = 65536.0;                    // grid lines per unit, openscad's CLIPPER_SCALE
constexpr double kCleaning = 0.001 * kGrid;          // points closer than this are taken for one

// Clipper's own limit is 4.6e18.
clip::cInt toGrid(double x) {
  const double scaled = x * kGrid;
  if (!(std::abs(scaled) < 4e18)) throw std::length_error("a coordinate too large for flat shapes");
  return static_cast<clip::cInt>(scaled);
}

clip::Path pathOf(const Outline& outline, bool keepDirection) {
  clip::Path path;
  path.reserve(outline.points.size());
  for (const glm::dvec2& p : outline.points) path.emplace_back(toGrid(p.x), toGrid(p.y));
  if (!keepDirection && !clip::Orientation(path)) std::reverse(path.begin(), path.end());
  return path;
}

clip::Paths pathsOf(const Flat& flat) {
  clip::Paths paths;
  for (const Outline& outline : flat.outlines) paths.push_back(pathOf(outline, flat.sanitized));
  return paths;
}

Flat flatOf(const clip::PolyTree& tree) {
  Flat flat;
  flat.sanitized = true;
  for (const clip::PolyNode* node = tree.GetFirst(); node; node = node->GetNext()) {
    Outline outline;
    outline.positive = clip::Orientation(node->Contour);
    clip::Path cleaned;
    clip::CleanPolygon(node->Contour, cleaned, kCleaning);
    if (cleaned.size() < 3) continue;
    for (const clip::IntPoint& p : cleaned) outline.points.emplace_back(static_cast<double>(p.X) / kGrid, static_cast<double>(p.Y) / kGrid);
    flat.outlines.push_back(std::move(outline));
  }
  return flat;
}

void sanitizeInto(const clip::Paths& paths, clip::PolyTree& tree) {
  clip::Clipper clipper;
  clipper.AddPaths(paths, clip::ptSubject, true);
  clipper.Execute(clip::ctUnion, tree, clip::pftEvenOdd);
}

Flat sanitize(const Flat& flat) {
  clip::PolyTree tree;
  sanitizeInto(pathsOf(flat), tree);
  return flatOf(tree);
}

clip::Paths operandPaths(const Flat& flat) {
  clip::Paths paths = pathsOf(flat);
  if (flat.sanitized) return paths;
  clip::PolyTree tree;
  sanitizeInto(paths, tree);
  clip::PolyTreeToPaths(tree, paths);
  return paths;
}

Flat intersect(const std::vector<clip::Paths>& operands) {
  clip::Paths source = operands.front();
  clip::PolyTree tree;
  for (std::size_t i = 1; i < operands.size(); ++i) {
    clip::Clipper clipper;
    clipper.AddPaths(source, clip::ptSubject, true);
    clipper.AddPaths(operands[i], clip::ptClip, true);
    clipper.Execute(clip::ctIntersection, tree, clip::pftNonZero, clip::pftNonZero);
    clip::PolyTreeToPaths(tree, source);
  }
  return flatOf(tree);
}

Flat combine(Keyword keyword, const std::vector<const Flat*>& operands) {
  if (operands.empty()) return Flat{{}, true};
  if (operands.size() == 1) return *operands.front();
  std::vector<clip::Paths> paths;
  for (const Flat* operand : operands) paths.push_back(operandPaths(*operand));
  if (keyword == Keyword::Intersection) return intersect(paths);
  clip::Clipper clipper;
  for (std::size_t i = 0; i < paths.size(); ++i) clipper.AddPaths(paths[i], i == 0 ? clip::ptSubject : clip::ptClip, true);
  clip::PolyTree tree;
  clipper.Execute(keyword == Keyword::Difference ? clip::ctDifference : clip::ctUnion, tree, clip::pftNonZero, clip::pftNonZero);
  return flatOf(tree);
}

Flat squareOf(const SyntaxTree& tree, const SyntaxNode& node) {
  Flat flat{{}, true};
  glm::dvec2 size(1);
  if (const Value* value = tree.find(node, "size", 0)) readNumbers(tree, *value, &size.x, 2);
  if (!(size.x > 0) || !(size.y > 0) || std::isinf(size.x) || std::isinf(size.y)) return flat;
  glm::dvec2 low(0), high(size);
  if (boolOr(tree, node, "center", false)) {
    low -= size / 2.0;
    high -= size / 2.0;
  }
  flat.outlines.push_back({{low, {high.x, low.y}, high, {low.x, high.y}}, true});
  return flat;
}

Flat circleOf(const SyntaxTree& tree, const SyntaxNode& node) {
  Flat flat{{}, true};
  const double r = radiusOf(tree, node, "r", "d", 1);
  if (!(r > 0) || std::isinf(r)) return flat;
  const int n = fragmentCount(r, fragmentsOf(tree, node));
  Outline outline;
  for (int i = 0; i < n; ++i) outline.points.push_back(circlePoint(r, i, n));
  flat.outlines.push_back(std::move(outline));
  return flat;
}

Flat polygonOf(const SyntaxTree& tree, const SyntaxNode& node) {
  Flat flat;
  const Value* points = tree.find(node, "points", 0);
  if (!points) tree.fail(node.textBegin, "polygon needs points");
  const std::vector<glm::dvec2> positions = points2Of(tree, *points);
  const Value* paths = tree.find(node, "paths", 1);
  IndexLists lists;
  if (paths && paths->kind == ValueKind::Vector && paths->itemCount() > 0) {
    lists = indexListsOf(tree, *paths, positions.size(), "path");
  } else {
    lists.indices.resize(positions.size());
    std::iota(lists.indices.begin(), lists.indices.end(), 0u);
    lists.ends.push_back(static_cast<std::uint32_t>(positions.size()));
  }
  std::uint32_t begin = 0;
  for (const std::uint32_t end : lists.ends) {
    Outline outline;
    for (; begin < end; ++begin) outline.points.push_back(positions[lists.indices[begin]]);
    if (outline.points.size() >= 3) flat.outlines.push_back(std::move(outline));
  }
  return sanitize(flat);
}

// Throws away what a matrix flattens; a mirrored shape is brought into order again.
Flat transformed(const SyntaxTree& tree, const SyntaxNode& node, Flat flat, std::vector<std::string>& warnings) {
  const glm::dmat4 m = matrixOf(tree, node);
  const double determinant = m[0].x * m[1].y - m[1].x * m[0].y;
  const glm::dvec2 shift(m[3]);
  const bool finite = std::isfinite(determinant) && std::isfinite(shift.x) && std::isfinite(shift.y);
  if (flat.empty()) return flat;
  if (!finite || determinant == 0) {
    warnings.push_back(fmt::format("{}:{}: a matrix flattens a 2D shape to nothing: it is left out", tree.name, tree.lineAt(node.textBegin)));
    return Flat{{}, true};
  }
  for (Outline& outline : flat.outlines) {
    for (glm::dvec2& p : outline.points) p = {m[0].x * p.x + m[1].x * p.y + shift.x, m[0].y * p.x + m[1].y * p.y + shift.y};
  }
  return flat.sanitized && determinant < 0 ? sanitize(flat) : flat;
}

// The outlines of the flat shape whose extrusion by 1 openscad has given us: the border of its lower face.
Flat flatOfExtrusion(const Mesh& mesh) {
  std::map<std::pair<double, double>, std::map<std::pair<double, double>, int>> edges;
  for (const glm::uvec3& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      // The lower face looks down: its edges run the other way round.
      const glm::dvec3 &a = mesh.vertices[t[(i + 1) % 3]], &b = mesh.vertices[t[i]], &c = mesh.vertices[t[(i + 2) % 3]];
      if (a.z != 0 || b.z != 0 || c.z != 0) continue;
      const std::pair<double, double> from{a.x, a.y}, to{b.x, b.y};
      const auto opposite = edges.find(to);
      if (opposite != edges.end() && opposite->second.count(from)) {
        if (--opposite->second[from] == 0) opposite->second.erase(from);
      } else {
        ++edges[from][to];
      }
    }
  }
  Flat flat{{}, true};
  for (auto& [start, targets] : edges) {
    while (!targets.empty()) {
      Outline outline;
      std::pair<double, double> at = start;
      for (auto found = edges.find(at); found != edges.end() && !found->second.empty(); found = edges.find(at)) {
        outline.points.emplace_back(at.first, at.second);
        const auto next = found->second.begin();
        at = next->first;
        if (--next->second == 0) found->second.erase(next);
      }
      double area = 0;
      for (std::size_t i = 0; i < outline.points.size(); ++i) {
        const glm::dvec2 &p = outline.points[i], &q = outline.points[(i + 1) % outline.points.size()];
        area += p.x * q.y - p.y * q.x;
      }
      outline.positive = area > 0;
      if (outline.points.size() >= 3) flat.outlines.push_back(std::move(outline));
    }
  }
  return flat;
}

class FlatEvaluator {
 public:
  FlatEvaluator(const SyntaxTree& tree, const ExternalShapes& external, std::vector<std::string>& warnings)
      : tree_(tree), external_(external), warnings_(warnings) {}

  // Children come after their parent, so a walk from the end meets them first.
  void evaluate(std::uint32_t begin, std::uint32_t end) {
    begin_ = begin;
    skipped_ = coveredByExternal(begin, end);
    results_.resize(end - begin);
    for (std::uint32_t i = end; i-- > begin;) {
      if (!skipped_[i - begin]) results_[i - begin] = one(i);
    }
  }

  Flat& result(std::uint32_t node) { return results_[node - begin_]; }

  Flat unionOfChildren(std::uint32_t node) { return combine(Keyword::Union, children(node, tree_.nodes[node].subtreeEnd)); }

 private:
  std::vector<bool> coveredByExternal(std::uint32_t begin, std::uint32_t end) const {
    std::vector<bool> skipped(end - begin, false);
    for (std::uint32_t i = begin; i < end;) {
      if (!isExternalNode(tree_, i)) {
        ++i;
        continue;
      }
      const std::uint32_t after = tree_.nodes[i].subtreeEnd;
      for (std::uint32_t k = i + 1; k < after; ++k) skipped[k - begin] = true;
      i = after;
    }
    return skipped;
  }

  std::vector<const Flat*> children(std::uint32_t node, std::uint32_t end) {
    std::vector<const Flat*> operands;
    for (std::uint32_t child = node + 1; child < end; child = tree_.nodes[child].subtreeEnd) {
      if (!(tree_.nodes[child].modifiers & (kBackground | kDisabled))) operands.push_back(&result(child));
    }
    return operands;
  }

  Flat one(std::uint32_t index) {
    const SyntaxNode& node = tree_.nodes[index];
    if (isExternalNode(tree_, index)) {
      const auto found = external_.shapes.find(index);
      const bool flat = found != external_.shapes.end() && found->second.flat && found->second.mesh;
      return flat ? flatOfExtrusion(*found->second.mesh) : Flat{{}, true};
    }
    switch (node.keyword) {
      case Keyword::Square: return squareOf(tree_, node);
      case Keyword::Circle: return circleOf(tree_, node);
      case Keyword::Polygon: return polygonOf(tree_, node);
      case Keyword::Multmatrix: return transformed(tree_, node, unionOfChildren(index), warnings_);
      default: break;
    }
    if (isTreeKeyword(node.keyword)) return combine(node.keyword, children(index, node.subtreeEnd));
    warnings_.push_back(fmt::format("{}:{}: a 3D {} within a 2D shape is left out", tree_.name, tree_.lineAt(node.textBegin), tree_.nameOf(node)));
    return Flat{{}, true};
  }

  const SyntaxTree& tree_;
  const ExternalShapes& external_;
  std::vector<std::string>& warnings_;
  std::uint32_t begin_ = 0;
  std::vector<bool> skipped_;
  std::vector<Flat> results_;
};

}  // namespace

std::size_t Flat::pointCount() const {
  std::size_t count = 0;
  for (const Outline& outline : outlines) count += outline.points.size();
  return count;
}

Flat flatOfChildren(const SyntaxTree& tree, std::uint32_t node, const ExternalShapes& external, std::vector<std::string>& warnings) {
  FlatEvaluator evaluator(tree, external, warnings);
  evaluator.evaluate(node + 1, tree.nodes[node].subtreeEnd);
  return evaluator.unionOfChildren(node);
}

Flat flatOfNode(const SyntaxTree& tree, std::uint32_t node, const ExternalShapes& external, std::vector<std::string>& warnings) {
  FlatEvaluator evaluator(tree, external, warnings);
  evaluator.evaluate(node, tree.nodes[node].subtreeEnd);
  return std::move(evaluator.result(node));
}

std::vector<glm::uvec3> areaOf(const Flat& flat) {
  std::vector<glm::dvec2> points;
  std::vector<std::uint32_t> ends;
  for (const Outline& outline : flat.outlines) {
    points.insert(points.end(), outline.points.begin(), outline.points.end());
    ends.push_back(static_cast<std::uint32_t>(points.size()));
  }
  if (std::optional<std::vector<glm::uvec3>> triangles = triangulate(points, ends)) return *triangles;
  // Cleaning may have made outlines cross by a grid step. A fan from the first corner covers the same area, counted with its signs.
  std::vector<glm::uvec3> fan;
  std::uint32_t begin = 0;
  for (const std::uint32_t end : ends) {
    for (std::uint32_t i = begin + 1; i + 1 < end; ++i) fan.emplace_back(begin, i, i + 1);
    begin = end;
  }
  return fan;
}

void addArea(MeshBuilder& builder, const std::vector<glm::uvec3>& area, std::uint32_t firstVertex, bool reversed) {
  builder.beginFacet();
  for (const glm::uvec3& t : area) {
    if (reversed) {
      builder.addTriangle(firstVertex + t.x, firstVertex + t.z, firstVertex + t.y);
    } else {
      builder.addTriangle(firstVertex + t.x, firstVertex + t.y, firstVertex + t.z);
    }
  }
}

}  // namespace copeel::csg
