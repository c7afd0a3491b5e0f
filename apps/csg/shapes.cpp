#include "apps/csg/shapes.h"

#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

#include "apps/csg/arguments.h"
#include "core/error.h"
#include "core/formats/read_mesh.h"

namespace copeel::csg {
namespace {

template <class... Numbers>
std::string keyOfNumbers(Keyword keyword, Numbers... numbers) {
  const double values[] = {static_cast<double>(numbers)...};
  std::string key(1 + sizeof(values), static_cast<char>(keyword));
  std::memcpy(key.data() + 1, values, sizeof(values));
  return key;
}

}  // namespace

bool isTreeKeyword(Keyword keyword) { return keyword <= Keyword::Render; }

bool isExternalKeyword(Keyword keyword) { return keyword >= Keyword::Text; }

bool isFlatKeyword(Keyword keyword) {
  return keyword >= Keyword::Square && keyword <= Keyword::Offset;
}

// The parameters that make the shape: equal keys, equal meshes.
std::string Shapes::keyOf(const SyntaxNode& node) const {
  const Fragments f = fragmentsOf(tree_, node);
  switch (node.keyword) {
    case Keyword::Cube: {
      glm::dvec3 size(1);
      if (const Value* value = tree_.find(node, "size", 0)) readNumbers(tree_, *value, &size.x, 3);
      return keyOfNumbers(node.keyword, size.x, size.y, size.z, boolOr(tree_, node, "center", false));
    }
    case Keyword::Sphere:
      return keyOfNumbers(node.keyword, radiusOf(tree_, node, "r", "d", 1), f.fn, f.fa, f.fs);
    case Keyword::Cylinder: {
      const double r = radiusOf(tree_, node, "r", "d", 1);
      return keyOfNumbers(node.keyword, numberOr(tree_, node, "h", 1, 0), radiusOf(tree_, node, "r1", "d1", r),
                          radiusOf(tree_, node, "r2", "d2", r), boolOr(tree_, node, "center", false), f.fn, f.fa, f.fs);
    }
    default: break;
  }
  // The text itself, without the white space that depends on the depth of nesting.
  std::string key;
  bool quoted = false;
  for (std::size_t i = node.textBegin; i < node.textEnd; ++i) {
    const char c = tree_.text[i];
    if (c == '"') quoted = !quoted;
    if (quoted || (c != ' ' && c != '\t' && c != '\n' && c != '\r')) key += c;
  }
  return key;
}

MeshPointer Shapes::meshOf(std::uint32_t index) {
  const SyntaxNode& node = tree_.nodes[index];
  std::string key = keyOf(node);
  const auto found = meshes_.find(key);
  if (found != meshes_.end()) return found->second;
  MeshPointer mesh;
  try {
    mesh = make(index);
  } catch (const std::length_error& cause) {
    tree_.fail(node.textBegin, fmt::format("{} has {}", tree_.nameOf(node), cause.what()));
  }
  meshes_.emplace(std::move(key), mesh);
  return mesh;
}

MeshPointer Shapes::make(std::uint32_t index) {
  const SyntaxNode& node = tree_.nodes[index];
  switch (node.keyword) {
    case Keyword::Cube: {
      glm::dvec3 size(1);
      if (const Value* value = tree_.find(node, "size", 0)) readNumbers(tree_, *value, &size.x, 3);
      return makeCube(size, boolOr(tree_, node, "center", false));
    }
    case Keyword::Sphere: return makeSphere(radiusOf(tree_, node, "r", "d", 1), fragmentsOf(tree_, node));
    case Keyword::Cylinder: return makeCylinderOf(node);
    case Keyword::Polyhedron: return makePolyhedronOf(node);
    default: tree_.fail(node.textBegin, fmt::format("{} is not supported yet", tree_.nameOf(node)));
  }
}

MeshPointer Shapes::makeCylinderOf(const SyntaxNode& node) const {
  const double r = radiusOf(tree_, node, "r", "d", 1);
  return makeCylinder(numberOr(tree_, node, "h", 1, 0), radiusOf(tree_, node, "r1", "d1", r), radiusOf(tree_, node, "r2", "d2", r),
                      boolOr(tree_, node, "center", false), fragmentsOf(tree_, node));
}

MeshPointer Shapes::makePolyhedronOf(const SyntaxNode& node) const {
  const Value* points = tree_.find(node, "points", 0);
  const Value* faces = tree_.find(node, "faces", 1);
  if (!points || !faces) tree_.fail(node.textBegin, "polyhedron needs points and faces");
  const std::vector<glm::dvec3> positions = points3Of(tree_, *points);
  const IndexLists lists = indexListsOf(tree_, *faces, positions.size(), "face");
  return makePolyhedron(positions, lists.indices, lists.ends);
}

}  // namespace copeel::csg
