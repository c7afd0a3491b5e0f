#include "apps/csg/shapes.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>
#include <glm/common.hpp>

#include "apps/csg/arguments.h"
#include "apps/csg/content_hash.h"
#include "apps/csg/extrude.h"
#include "apps/csg/flat.h"
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

std::string fileOf(const SyntaxTree& tree, const SyntaxNode& node) {
  const Value* file = tree.find(node, "file", 0);
  return file && file->kind == ValueKind::String ? tree.stringOf(*file) : "";
}

std::string extensionOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return extension;
}

// What openscad imports by itself goes through openscad; meshes we read as they are, in full precision.
bool isMeshFile(const std::string& file) {
  const std::string extension = extensionOf(file);
  return extension == ".stl" || extension == ".off" || extension == ".obj" || extension == ".ply";
}

bool isFlatFile(const std::string& file) { return extensionOf(file) == ".dxf" || extensionOf(file) == ".svg"; }

}  // namespace

bool isTreeKeyword(Keyword keyword) { return keyword <= Keyword::Render; }

bool showsMarksWithin(Keyword keyword) {
  return keyword == Keyword::Hull || keyword == Keyword::Minkowski || keyword == Keyword::Resize;
}

bool isExternalNode(const SyntaxTree& tree, std::uint32_t index) {
  const SyntaxNode& node = tree.nodes[index];
  if (node.keyword >= Keyword::Text) return true;
  const Value* file = tree.find(node, "file");
  const bool namesFile = file && file->kind == ValueKind::String && file->textLength() > 0;
  if (node.keyword == Keyword::LinearExtrude || node.keyword == Keyword::RotateExtrude) return namesFile;   // of a DXF, long deprecated
  return node.keyword == Keyword::Import && !isMeshFile(fileOf(tree, node));
}

std::vector<std::uint8_t> dimensionsOf(const SyntaxTree& tree) {
  std::vector<std::uint8_t> dimensions(tree.nodes.size(), 0);
  // Children come after their parent: a walk from the end knows them.
  for (std::size_t i = tree.nodes.size(); i-- > 0;) {
    const SyntaxNode& node = tree.nodes[i];
    switch (node.keyword) {
      case Keyword::Square: case Keyword::Circle: case Keyword::Polygon: case Keyword::Text: case Keyword::Offset: case Keyword::Projection:
        dimensions[i] = 2;
        continue;
      case Keyword::Import: dimensions[i] = isFlatFile(fileOf(tree, node)) ? 2 : 3; continue;
      default: break;
    }
    if (!isTreeKeyword(node.keyword) && !showsMarksWithin(node.keyword)) {
      dimensions[i] = 3;
      continue;
    }
    for (std::size_t child = i + 1; child < node.subtreeEnd && dimensions[i] == 0; child = tree.nodes[child].subtreeEnd) {
      if (!(tree.nodes[child].modifiers & (kBackground | kDisabled))) dimensions[i] = dimensions[child];
    }
  }
  return dimensions;
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
  // The text, without the white space that depends on the depth of nesting; where strings are in it, as it stands. It may be as long as the
  // file, and shapes may stand within shapes.
  const std::string_view text = tree_.text.substr(node.textBegin, node.textEnd - node.textBegin);
  ContentHash hash;
  if (text.find('"') == std::string_view::npos) hash.addDense(text);
  else hash.add(text);
  return hash.hex();
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
    case Keyword::Square: case Keyword::Circle: case Keyword::Polygon: return slabOf(flatOfNode(tree_, index, external_, warnings_));
    case Keyword::LinearExtrude: return isExternalNode(tree_, index) ? makeExternal(index) : makeLinearExtrude(index);
    case Keyword::RotateExtrude: return isExternalNode(tree_, index) ? makeExternal(index) : makeRotateExtrude(index);
    case Keyword::Import: return isExternalNode(tree_, index) ? makeExternal(index) : makeImport(node);
    default: return makeExternal(index);
  }
}

MeshPointer Shapes::makeExternal(std::uint32_t index) {
  const auto found = external_.shapes.find(index);
  if (found == external_.shapes.end()) return nullptr;
  return found->second.flat ? slabOf(flatOfNode(tree_, index, external_, warnings_)) : found->second.mesh;
}

MeshPointer Shapes::makeLinearExtrude(std::uint32_t index) {
  const SyntaxNode& node = tree_.nodes[index];
  LinearExtrusion how;
  how.height = numberOr(tree_, node, "height", how.height, 0);
  how.center = boolOr(tree_, node, "center", false);
  how.twist = numberOr(tree_, node, "twist", 0);
  how.hasTwist = how.twist != 0;
  const double slices = numberOr(tree_, node, "slices", 0);
  if (slices >= kMaxSolidCorners) throw std::length_error("more than 2e7 slices");
  if (slices > 0) how.slices = std::max(static_cast<int>(slices), 1);
  if (const Value* scale = tree_.find(node, "scale")) readNumbers(tree_, *scale, &how.scale.x, 2);
  how.scale = glm::max(how.scale, glm::dvec2(0));
  how.fragments = fragmentsOf(tree_, node);
  return extrude(flatOfChildren(tree_, index, external_, warnings_), how);
}

MeshPointer Shapes::makeRotateExtrude(std::uint32_t index) {
  const SyntaxNode& node = tree_.nodes[index];
  double angle = numberOr(tree_, node, "angle", 360);
  if (angle <= -360 || angle > 360) angle = 360;
  const Flat flat = flatOfChildren(tree_, index, external_, warnings_);
  if (crossesAxis(flat)) {
    warnings_.push_back(fmt::format("{}:{}: rotate_extrude of a shape on both sides of the axis: it is left out", tree_.name,
                                    tree_.lineAt(node.textBegin)));
  }
  return rotateExtrude(flat, angle, fragmentsOf(tree_, node));
}

MeshPointer Shapes::makeImport(const SyntaxNode& node) {
  const std::filesystem::path file = std::filesystem::path(folder_) / fileOf(tree_, node);
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) tree_.fail(node.textBegin, fmt::format("{}: no such file", file.string()));
  Mesh mesh = readMesh(file.string());
  const std::string found = statusOf(mesh).summary();
  if (!found.empty()) warnings_.push_back(fmt::format("{}: {}", file.string(), found));
  return mesh.triangles.empty() ? nullptr : std::make_shared<const Mesh>(std::move(mesh));
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
