// Triangles go straight into the mesh. Polygons wait beside it and are woven in, in the file's order, when all vertices are known.
#include "core/formats/soup_builder.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "core/formats/polygon.h"

namespace copeel {

void SoupBuilder::reserve(std::size_t vertices, std::size_t triangles) {
  mesh_.vertices.reserve(vertices);
  mesh_.triangles.reserve(triangles);
}

void SoupBuilder::addFace(std::span<const std::uint32_t> corners, std::size_t place) {
  for (const std::uint32_t corner : corners) {
    if (corner <= highestIndex_) continue;
    highestIndex_ = corner;
    highestPlace_ = place;
  }
  if (corners.size() == 3) {
    mesh_.triangles.emplace_back(corners[0], corners[1], corners[2]);
  } else if (corners.size() > 3) {
    polygons_.push_back({mesh_.triangles.size(), corners_.size(), corners.size(), place});
    corners_.insert(corners_.end(), corners.begin(), corners.end());
  }
}

Mesh SoupBuilder::finish() {
  checkIndices();
  if (!polygons_.empty()) cutPolygons();
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
  std::size_t done = 0;
  const auto copyPlain = [&](std::size_t end) {
    for (; done < end; ++done) {
      mesh_.triangles.push_back(plain[done]);
      mesh_.facets.push_back(facet++);
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
    facet += shared;
  }
  copyPlain(plain.size());
}

}  // namespace copeel
