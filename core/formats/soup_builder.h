// What all readers fill: vertices, faces of any size, and the place of each face for messages. Faces may come before their vertices;
// indices are checked, and polygons cut, when all is read. Faces of one or two corners (points, edges) are checked and leave no triangle.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec4.hpp>

#include "core/formats/input_file.h"
#include "core/scene/mesh.h"

namespace copeel {

class SoupBuilder {
 public:
  enum class Place { Line, Byte };
  // firstIndex: what the file calls its first vertex (OBJ counts from 1).
  SoupBuilder(const Source& source, Place kind, int firstIndex = 0)
      : source_(source), kind_(kind), firstIndex_(firstIndex) {}

  // A hint. Counts in a header may lie, so callers bound them by what the rest of the file could hold.
  void reserve(std::size_t vertices, std::size_t triangles);
  void setSinglePrecision() { mesh_.singlePrecision = true; }

  std::size_t vertexCount() const { return mesh_.vertices.size(); }
  void addVertex(const glm::dvec3& position) { mesh_.vertices.push_back(position); }
  // For files that give each face vertices of its own: the index of a vertex with these coordinates, to the bit. One met lately serves again, which
  // most do: it takes a quarter of the memory, and time to project.
  std::uint32_t sharedVertex(const glm::dvec3& position, std::size_t place);
  // Colours as in Mesh::colors. Of the faces from here on; where no face has one, those of the vertices count, given for each vertex or for none.
  void setFaceColor(const glm::vec4& color);
  void addVertexColor(const glm::vec4& color) { vertexColors_.push_back(color); }
  // Corners count from 0.
  void addFace(std::span<const std::uint32_t> corners, std::size_t place);
  // A vertex number of the file, already from 0, as an index; fails when it cannot be one.
  std::uint32_t index(std::int64_t value, std::size_t place) const {
    if (value < 0 || value >= kLargestIndex) failIndex(value, place);
    return static_cast<std::uint32_t>(value);
  }

  Mesh finish();

 private:
  static constexpr std::int64_t kLargestIndex = 0xffffffff;
  struct Polygon {
    std::size_t triangleBefore;  // it stands after this many plain triangles
    std::size_t firstCorner;     // in corners_
    std::size_t cornerCount;
    std::size_t place;
  };

  [[noreturn]] void failIndex(std::int64_t value, std::size_t place) const;
  template <class... Args>
  [[noreturn]] void failAt(std::size_t place, fmt::format_string<Args...> format, Args&&... args) const {
    if (kind_ == Place::Line) source_.failAtLine(place, format, std::forward<Args>(args)...);
    source_.failAtByte(place, format, std::forward<Args>(args)...);
  }
  void checkIndices() const;
  void cutPolygons();
  std::size_t faceCount() const { return mesh_.triangles.size() + polygons_.size(); }   // before polygons are cut
  bool hasColors() const { return hasFaceColors_ || !vertexColors_.empty(); }
  void addColors(std::size_t face, std::span<const std::uint32_t> corners, std::size_t triangleCount);

  const Source& source_;
  Place kind_;
  int firstIndex_;
  Mesh mesh_;
  std::vector<std::uint32_t> lately_;   // vertices by a hash of their coordinates, the last one that had it; kNone
  std::vector<Polygon> polygons_;
  std::vector<std::uint32_t> corners_;
  bool hasFaceColors_ = false;
  std::vector<glm::vec4> faceColors_;       // per face of three corners or more, where hasFaceColors_
  std::vector<glm::vec4> vertexColors_;
  glm::vec4 faceColor_{Mesh::kNotGiven};
  std::int64_t highestIndex_ = -1;  // of any face; one comparison at the end checks them all
  std::size_t highestPlace_ = 0;
};

}  // namespace copeel
