// Triangles go straight into the mesh. Polygons wait beside it and are woven in, in the file's order, when all vertices are known.
#include "core/formats/soup_builder.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>
#include <utility>

#include "core/formats/polygon.h"

namespace copeel {
namespace {

std::span<const std::uint32_t> cornersOf(const glm::uvec3& triangle) { return {&triangle.x, 3}; }

}  // namespace

void SoupBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  mesh_.vertices.reserve(vertices);
  mesh_.triangles.reserve(triangles);
}

std::uint32_t SoupBuilder::sharedVertex(const glm::dvec3& position, std::size_t place) {
  constexpr std::size_t kPlaces = 1 << 16;
  constexpr std::uint32_t kNone = ~std::uint32_t{0};
  if (lately_.empty()) lately_.assign(kPlaces, kNone);
  std::uint64_t hash = 0;
  for (int k = 0; k < 3; ++k) hash = (hash ^ std::bit_cast<std::uint64_t>(position[k])) * 0x9E3779B97F4A7C15ull, hash ^= hash >> 32;
  std::uint32_t& last = lately_[hash % kPlaces];
  if (last == kNone || std::memcmp(&mesh_.vertices[last], &position, sizeof position) != 0) {
    last = index(static_cast<std::int64_t>(vertexCount()), place);
    addVertex(position);
  }
  return last;
}

void SoupBuilder::addFace(std::span<const std::uint32_t> corners, std::size_t place) {
  for (const std::uint32_t corner : corners) {
    if (corner <= highestIndex_) continue;
    highestIndex_ = corner;
    highestPlace_ = place;
  }
  if (corners.size() < 3) return;
  if (corners.size() == 3) {
    mesh_.triangles.emplace_back(corners[0], corners[1], corners[2]);
  } else {
    polygons_.push_back({mesh_.triangles.size(), corners_.size(), corners.size(), place});
    corners_.insert(corners_.end(), corners.begin(), corners.end());
  }
  if (hasFaceColors_) faceColors_.push_back(faceColor_);
}

void SoupBuilder::setFaceColor(const glm::vec4& color) {
  // The faces before the first colour have none.
  if (!hasFaceColors_) faceColors_.assign(faceCount(), glm::vec4(Mesh::kNotGiven));
  hasFaceColors_ = true;
  faceColor_ = color;
}

// A face's own colour, or the mean of its corners', for each triangle that it was cut into.
void SoupBuilder::addColors(std::size_t face, std::span<const std::uint32_t> corners, std::size_t triangleCount) {
  if (!hasColors()) return;
  glm::vec4 color(0);
  if (hasFaceColors_) {
    color = faceColors_[face];
  } else {
    for (const std::uint32_t corner : corners) color += vertexColors_[corner] / static_cast<float>(corners.size());
  }
  mesh_.colors.insert(mesh_.colors.end(), triangleCount, color);
}

Mesh SoupBuilder::finish() {
  checkIndices();
  vertexColors_.resize(vertexColors_.empty() ? 0 : vertexCount(), glm::vec4(Mesh::kNotGiven));
  if (!polygons_.empty()) {
    cutPolygons();
  } else {
    for (std::size_t face = 0; face < (hasColors() ? mesh_.triangles.size() : 0); ++face) addColors(face, cornersOf(mesh_.triangles[face]), 1);
  }
  if (mesh_.triangles.size() > std::numeric_limits<std::uint32_t>::max()) {
    source_.fail("{} triangles are more than can be numbered", mesh_.triangles.size());
  }
  return std::move(mesh_);
}

void SoupBuilder::checkIndices() const {
  if (highestIndex_ >= static_cast<std::int64_t>(vertexCount())) failIndex(highestIndex_, highestPlace_);
}

void SoupBuilder::failIndex(std::int64_t value, std::size_t place) const {
  failAt(place, "vertex index {} is out of range: the file has {} vertices", value + firstIndex_, vertexCount());
}

void SoupBuilder::cutPolygons() {
  const std::vector<glm::uvec3> plain = std::exchange(mesh_.triangles, {});
  mesh_.triangles.reserve(plain.size() + corners_.size() - 2 * polygons_.size());
  PolygonCutter cutter;
  std::vector<glm::dvec3> positions;
  std::uint32_t facet = 0;
  std::size_t done = 0, face = 0;
  const auto copyPlain = [&](std::size_t end) {
    for (; done < end; ++done) {
      mesh_.triangles.push_back(plain[done]);
      mesh_.facets.push_back(facet++);
      addColors(face++, cornersOf(plain[done]), 1);
    }
  };
  for (const Polygon& polygon : polygons_) {
    copyPlain(polygon.triangleBefore);
    const std::uint32_t* corners = &corners_[polygon.firstCorner];
    positions.clear();
    for (std::size_t i = 0; i < polygon.cornerCount; ++i) positions.push_back(mesh_.vertices[corners[i]]);
    const PolygonCutter::Result result = cutter.cut(positions, mesh_.singlePrecision);
    if (result == PolygonCutter::Result::TooComplex) {
      failAt(polygon.place, "a face of {} corners takes too long to cut into triangles", polygon.cornerCount);
    }
    const bool shared = result == PolygonCutter::Result::Planar;
    for (const glm::uvec3& t : cutter.triangles()) {
      mesh_.triangles.emplace_back(corners[t.x], corners[t.y], corners[t.z]);
      mesh_.facets.push_back(shared ? facet : facet++);
    }
    addColors(face++, {corners, polygon.cornerCount}, cutter.triangles().size());
    facet += shared;
  }
  copyPlain(plain.size());
}

}  // namespace copeel
