// SPDX-License-Identifier: GPL-3.0-or-later (uses CGAL's Polygon_mesh_processing and Nef_3)
#include "validation/exact_boolean.h"

#include <exception>
#include <map>
#include <utility>
#include <vector>

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/orientation.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/self_intersections.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <gmpxx.h>

namespace copeel::validation {
namespace {

namespace PMP = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Point = Kernel::Point_3;
using SurfaceMesh = CGAL::Surface_mesh<Point>;
using Nef = CGAL::Nef_polyhedron_3<Kernel>;

// CGAL chooses its rationals at compile time; each choice wraps GMP's.
[[maybe_unused]] mpq_class rational(const mpq_class& q) { return q; }
template <class Q>
  requires requires(const Q& q) { q.mpq(); }
mpq_class rational(const Q& q) {
  return mpq_class(q.mpq());
}
template <class Q>
  requires requires(const Q& q) { q.backend().data(); }
mpq_class rational(const Q& q) {
  return mpq_class(q.backend().data());
}

std::uint32_t addVertex(OracleMesh& mesh, const Point& p) {
  ExactPoint exact{rational(CGAL::exact(p.x())), rational(CGAL::exact(p.y())), rational(CGAL::exact(p.z()))};
  mesh.vertices.push_back({exact[0].get_d(), exact[1].get_d(), exact[2].get_d()});
  mesh.exactVertices.push_back(std::move(exact));
  return std::uint32_t(mesh.vertices.size() - 1);
}

// A leaf as CGAL wants it: vertices merged by position, oriented outwards. Nothing when it bounds no volume without crossing itself.
std::optional<SurfaceMesh> surfaceMesh(const OracleMesh& leaf) {
  std::map<std::array<double, 3>, std::size_t> number;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
  const auto numberOf = [&](std::uint32_t i) {
    const glm::dvec3& p = leaf.vertices[i];
    const auto [place, isNew] = number.try_emplace({p.x + 0.0, p.y + 0.0, p.z + 0.0}, points.size());
    if (isNew) points.emplace_back(p.x, p.y, p.z);
    return place->second;
  };
  for (const glm::uvec3& t : leaf.triangles) {
    const std::size_t a = numberOf(t.x), b = numberOf(t.y), c = numberOf(t.z);
    if (a != b && b != c && c != a) faces.push_back({a, b, c});
  }
  if (!PMP::is_polygon_soup_a_polygon_mesh(faces)) return std::nullopt;

  SurfaceMesh mesh;
  PMP::polygon_soup_to_polygon_mesh(points, faces, mesh);
  if (!CGAL::is_closed(mesh) || PMP::does_self_intersect(mesh)) return std::nullopt;
  if (!mesh.is_empty() && !PMP::is_outward_oriented(mesh)) PMP::reverse_face_orientations(mesh);
  return mesh;
}

// One Boolean of two solids by corefinement; false when the result is not manifold. Empty solids never reach CGAL.
bool combine(csg::Operation operation, SurfaceMesh& a, SurfaceMesh& b, SurfaceMesh& out) {
  const bool emptyA = a.is_empty(), emptyB = b.is_empty();
  if (emptyA || emptyB) {
    if (operation == csg::Operation::Union) out = emptyA ? b : a;
    if (operation == csg::Operation::Difference) out = a;
    return true;
  }
  bool done = false;
  if (operation == csg::Operation::Union) done = PMP::corefine_and_compute_union(a, b, out);
  if (operation == csg::Operation::Intersection) done = PMP::corefine_and_compute_intersection(a, b, out);
  if (operation == csg::Operation::Difference) done = PMP::corefine_and_compute_difference(a, b, out);
  out.collect_garbage();
  return done;
}

Nef combine(csg::Operation operation, const Nef& a, const Nef& b) {
  // Nef polyhedra know open and closed boundaries; solids keep their closure and lose walls without volume.
  if (operation == csg::Operation::Union) return (a + b).regularization();
  if (operation == csg::Operation::Intersection) return (a * b).regularization();
  return (a - b).regularization();
}

// Folds a model's tree over solids of some kind: leaf(i) makes one, join(operation, a, b) combines two. Nothing as soon as either has nothing.
template <class Solid, class MakeLeaf, class Join>
std::optional<Solid> foldTree(const csg::Model& model, MakeLeaf makeLeaf, Join join) {
  std::vector<std::optional<Solid>> values(model.nodes.size());
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    const csg::Node& node = model.nodes[n];
    if (node.operation == csg::Operation::Leaf) {
      values[n] = makeLeaf(node.leaf);
      if (!values[n]) return std::nullopt;
      continue;
    }
    Solid value{};
    for (std::uint32_t i = 0; i < node.childCount; ++i) {
      const Solid& child = *values[model.childIndices[node.firstChild + i]];
      if (i == 0) {
        value = child;
        continue;
      }
      std::optional<Solid> joined = join(node.operation, value, child);
      if (!joined) return std::nullopt;
      value = std::move(*joined);
    }
    values[n] = std::move(value);
  }
  return values[model.root];
}

std::optional<OracleMesh> byCorefinement(const csg::Model& model, const std::vector<SurfaceMesh>& leaves) {
  const auto solid = foldTree<SurfaceMesh>(
      model, [&](std::uint32_t leaf) { return std::optional<SurfaceMesh>(leaves[leaf]); },
      [](csg::Operation operation, const SurfaceMesh& a, const SurfaceMesh& b) -> std::optional<SurfaceMesh> {
        SurfaceMesh first = a, second = b, out;   // corefinement cuts its operands
        if (!combine(operation, first, second, out)) return std::nullopt;
        return out;
      });
  if (!solid) return std::nullopt;

  OracleMesh result;
  std::map<SurfaceMesh::Vertex_index, std::uint32_t> number;
  for (const auto v : solid->vertices()) number[v] = addVertex(result, solid->point(v));
  for (const auto f : solid->faces()) {
    std::vector<std::uint32_t> corners;
    for (const auto v : solid->vertices_around_face(solid->halfedge(f))) corners.push_back(number[v]);
    for (std::size_t i = 2; i < corners.size(); ++i) result.triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
  return result;
}

std::optional<OracleMesh> byNef(const csg::Model& model, std::vector<SurfaceMesh>& leaves) {
  const auto solid = foldTree<Nef>(
      model, [&](std::uint32_t leaf) { return std::optional<Nef>(leaves[leaf].is_empty() ? Nef() : Nef(leaves[leaf])); },
      [](csg::Operation operation, const Nef& a, const Nef& b) { return std::optional<Nef>(combine(operation, a, b)); });
  if (!solid) return std::nullopt;

  OracleMesh result;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> faces;
  CGAL::convert_nef_polyhedron_to_polygon_soup(*solid, points, faces, true);
  for (const Point& p : points) addVertex(result, p);
  for (const auto& f : faces) result.triangles.push_back({std::uint32_t(f[0]), std::uint32_t(f[1]), std::uint32_t(f[2])});
  return result;
}

}  // namespace

std::optional<OracleMesh> exactBoolean(const csg::Model& model, ExactKernel kernel) {
  if (model.root == csg::kNoNode) return OracleMesh{};
  std::vector<SurfaceMesh> leaves;
  for (std::uint32_t i = 0; i < model.leaves.size(); ++i) {
    std::optional<SurfaceMesh> mesh = surfaceMesh(leafMesh(model, i));
    if (!mesh) return std::nullopt;
    leaves.push_back(std::move(*mesh));
  }
  // A failed assertion within CGAL is an exception: no answer.
  try {
    return kernel == ExactKernel::Nef ? byNef(model, leaves) : byCorefinement(model, leaves);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace copeel::validation
