#include "apps/bench/scenes.h"

#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <random>
#include <utility>

#include <glm/ext/matrix_transform.hpp>

#include "core/error.h"
#include "core/formats/read_mesh.h"
#include "core/scene/camera.h"

namespace copeel::bench {
namespace {

using MeshPointer = std::shared_ptr<const Mesh>;

constexpr float kAlpha = 0.3f;
constexpr unsigned kSmall = 50;       // columns and rows of bodies that come several times
constexpr int kCityEdge = 8;          // towers a side
constexpr int kHairs = 600, kHairJoints = 12;

MeshPointer share(Mesh mesh) { return std::make_shared<const Mesh>(std::move(mesh)); }

// Colours of the parts in turn; every part glass, so that everything counts.
oit::Part partOf(const MeshPointer& mesh, std::size_t index, const glm::dmat4& worldFromObject = glm::dmat4(1.0)) {
  static constexpr float kColors[][3] = {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {0, 114, 178}, {213, 94, 0}, {204, 121, 167}};
  const auto& c = kColors[index % std::size(kColors)];
  return {mesh, {c[0], c[1], c[2], kAlpha}, {}, worldFromObject};
}

// A sphere of latitude and longitude whose radius is a function of its direction; poles are fans.
template <class Radius>
void appendSphere(Mesh& mesh, unsigned columns, unsigned rows, Radius radius) {
  const auto base = static_cast<unsigned>(mesh.vertices.size());
  const auto at = [&](unsigned row, unsigned column) { return base + row * columns + column % columns; };
  for (unsigned r = 0; r < rows; ++r) {
    const double phi = std::numbers::pi * (r + 0.5) / rows;
    for (unsigned c = 0; c < columns; ++c) {
      const double theta = 2 * std::numbers::pi * c / columns;
      mesh.vertices.push_back(radius(phi, theta) * glm::dvec3(std::sin(phi) * std::cos(theta), std::sin(phi) * std::sin(theta), std::cos(phi)));
    }
  }
  for (unsigned c = 1; c + 1 < columns; ++c) {
    mesh.triangles.emplace_back(at(0, 0), at(0, c), at(0, c + 1));
    mesh.triangles.emplace_back(at(rows - 1, 0), at(rows - 1, c + 1), at(rows - 1, c));
  }
  for (unsigned r = 0; r + 1 < rows; ++r) {
    for (unsigned c = 0; c < columns; ++c) {
      mesh.triangles.emplace_back(at(r, c), at(r + 1, c), at(r + 1, c + 1));
      mesh.triangles.emplace_back(at(r, c), at(r + 1, c + 1), at(r, c + 1));
    }
  }
}

Mesh cube() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.vertices.emplace_back(i & 1, i >> 1 & 1, i >> 2);
  constexpr unsigned kFaces[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (const auto& f : kFaces) {
    mesh.triangles.emplace_back(f[0], f[1], f[2]);
    mesh.triangles.emplace_back(f[0], f[2], f[3]);
  }
  return mesh;
}

// The square [-1, 1]² of cells, each cut along one diagonal or the other.
Mesh cutSquare(unsigned cells, bool otherDiagonal) {
  Mesh mesh;
  for (unsigned y = 0; y <= cells; ++y) {
    for (unsigned x = 0; x <= cells; ++x) mesh.vertices.emplace_back(2.0 * x / cells - 1, 2.0 * y / cells - 1, 0);
  }
  for (unsigned y = 0; y < cells; ++y) {
    for (unsigned x = 0; x < cells; ++x) {
      const unsigned a = y * (cells + 1) + x, b = a + 1, d = a + cells + 1, c = d + 1;
      mesh.triangles.push_back(otherDiagonal ? glm::uvec3(a, b, d) : glm::uvec3(a, b, c));
      mesh.triangles.push_back(otherDiagonal ? glm::uvec3(b, c, d) : glm::uvec3(a, c, d));
    }
  }
  return mesh;
}

glm::dmat4 turned(double degrees, const glm::dvec3& axis) { return glm::rotate(glm::dmat4(1.0), glm::radians(degrees), glm::normalize(axis)); }

// Each copy turned by an angle of its own and back: the matrices are the identity to 1e-16, and not to the bit.
BenchScene turnedCopies(std::size_t count) {
  BenchScene scene{"turned", "copies turned and turned back", {}};
  const MeshPointer mesh = share(bumpySphere(kSmall, kSmall));
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dvec3 axis(1, 2, 3 + double(i));
    scene.parts.push_back(partOf(mesh, i, turned(17.0 * double(i), axis) * turned(-17.0 * double(i), axis)));
  }
  return scene;
}

// Squares of 7, 10 and 13 cells a side, in one tilted plane.
BenchScene cutInTwoWays() {
  BenchScene scene{"cut", "one tilted plane, tessellated in three ways", {}};
  const glm::dmat4 tilt = turned(31, {1, 0.4, 0.2});
  scene.parts = {partOf(share(cutSquare(7, false)), 0, tilt), partOf(share(cutSquare(10, true)), 1, tilt), partOf(share(cutSquare(13, false)), 2, tilt)};
  return scene;
}

BenchScene city() {
  BenchScene scene{"city", "unit boxes that share faces", {}};
  const MeshPointer box = share(cube());
  for (int x = 0; x < kCityEdge; ++x) {
    for (int y = 0; y < kCityEdge; ++y) {
      const int height = 1 + (x * 5 + y * 3 + x * y) % 4;
      for (int z = 0; z < height; ++z) scene.parts.push_back(partOf(box, std::size_t(x + y + z), glm::translate(glm::dmat4(1.0), glm::dvec3(x, y, z))));
    }
  }
  return scene;
}

// Three-sided tubes that wander from a ball.
Mesh hairs(int count, int joints) {
  Mesh mesh;
  std::mt19937 random(7);
  // The standard fixes this engine's numbers, not those of its distributions.
  const auto uniform = [&] { return double(random()) / 4294967296.0 * 2 - 1; };
  for (int h = 0; h < count; ++h) {
    glm::dvec3 at(uniform(), uniform(), uniform());
    glm::dvec3 step = 0.12 * glm::normalize(at + glm::dvec3(1e-3, 0, 0));
    at *= 0.4;
    const auto base = static_cast<unsigned>(mesh.vertices.size());
    for (int j = 0; j <= joints; ++j, at += step) {
      const double radius = 0.012;
      mesh.vertices.push_back(at + glm::dvec3(radius, 0, 0));
      mesh.vertices.push_back(at + glm::dvec3(0, radius, 0));
      mesh.vertices.push_back(at + glm::dvec3(0, 0, radius));
      step = 0.12 * glm::normalize(step + 0.06 * glm::dvec3(uniform(), uniform(), uniform()));
    }
    for (unsigned j = 0; j < unsigned(joints); ++j) {
      for (unsigned s = 0; s < 3; ++s) {
        const unsigned a = base + 3 * j + s, b = base + 3 * j + (s + 1) % 3;
        mesh.triangles.emplace_back(a, b, b + 3);
        mesh.triangles.emplace_back(a, b + 3, a + 3);
      }
    }
  }
  return mesh;
}

}  // namespace

Mesh bumpySphere(unsigned columns, unsigned rows) {
  Mesh mesh;
  appendSphere(mesh, columns, rows, [](double phi, double theta) { return 1 + 0.12 * std::sin(7 * theta) * std::sin(phi) * std::sin(6 * phi); });
  return mesh;
}

Mesh shells(unsigned count, unsigned columns, unsigned rows) {
  Mesh mesh;
  for (unsigned i = 0; i < count; ++i) appendSphere(mesh, columns, rows, [&](double, double) { return 1 - 0.8 * i / count; });
  return mesh;
}

BenchScene copies(const Mesh& mesh, std::size_t count, std::string name) {
  BenchScene scene{std::move(name), fmt::format("{} coincident copies", count), {}};
  const MeshPointer shared = share(mesh);
  for (std::size_t i = 0; i < count; ++i) scene.parts.push_back(partOf(shared, i));
  return scene;
}

BenchScene threeInARow() {
  BenchScene scene{"row", "three bodies in a row along the view", {}, true};
  const MeshPointer mesh = share(bumpySphere(kSmall, kSmall));
  for (std::size_t i = 0; i < 3; ++i) scene.parts.push_back(partOf(mesh, i, glm::translate(glm::dmat4(1.0), glm::dvec3(-2.5 * double(i), 0, 0))));
  return scene;
}

const std::vector<std::string>& sceneNames() {
  static const std::vector<std::string> names = {"sphere", "copies", "turned", "cut", "city", "hair", "row"};
  return names;
}

BenchScene sceneOf(const std::string& name, std::size_t copyCount) {
  if (name == "sphere") {
    BenchScene scene = copies(bumpySphere(100, 100), 1, "sphere");
    scene.title = "a bumpy sphere";
    return scene;
  }
  if (name == "copies") return copies(bumpySphere(kSmall, kSmall), copyCount, "copies");
  if (name == "turned") return turnedCopies(copyCount);
  if (name == "cut") return cutInTwoWays();
  if (name == "city") return city();
  if (name == "hair") return {"hair", "a ball of hairs", {partOf(share(hairs(kHairs, kHairJoints)), 0)}};
  if (name == "row") return threeInARow();
  BenchScene scene = copies(readMesh(name), copyCount, std::filesystem::path(name).stem().string());
  scene.title = fmt::format("{} ({} coincident copies)", scene.name, copyCount);
  return scene;
}

View viewOf(const BenchScene& scene, const Box& bounds, int width, int height) {
  CameraOptions camera;
  camera.width = width;
  camera.height = height;
  if (scene.alongAxis) {
    const glm::dvec3 center = bounds.center(), eye = center + glm::dvec3(1.6 * bounds.diagonal(), 0.01, 0.02);
    camera.camera = {eye.x, eye.y, eye.z, center.x, center.y, center.z};
  }
  return copeel::viewOf(camera, bounds);
}

}  // namespace copeel::bench
