#include "apps/bench/scenes.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <utility>

#include <fmt/format.h>
#include <glm/ext/matrix_transform.hpp>

#include "core/formats/read_mesh.h"

namespace copeel::bench {
namespace {

using MeshPointer = std::shared_ptr<const Mesh>;

constexpr float kAlpha = 0.3f;
constexpr unsigned kSmall = 50;       // columns and rows of bodies that come several times
constexpr int kCityEdge = 8;          // towers a side
constexpr int kHairs = 600, kHairJoints = 12;
constexpr double kStackNear = 4, kStackFar = 6;   // distances of a stack's rectangles from the eye

MeshPointer share(Mesh mesh) { return std::make_shared<const Mesh>(std::move(mesh)); }

// Colours of the parts in turn; every part glass, so that everything counts.
oit::Part partOf(const MeshPointer& mesh, std::size_t index, const glm::dmat4& worldFromObject = glm::dmat4(1.0)) {
  static constexpr float kColors[][3] = {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {0, 114, 178}, {213, 94, 0}, {204, 121, 167}};
  const auto& c = kColors[index % std::size(kColors)];
  return {mesh, {c[0], c[1], c[2], kAlpha}, {}, worldFromObject};
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
BenchScene cutInThreeWays() {
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

}  // namespace

BenchScene copies(const Mesh& mesh, std::size_t count, std::string name) {
  BenchScene scene{std::move(name), fmt::format("{} coincident copies", count), {}};
  const MeshPointer shared = share(mesh);
  for (std::size_t i = 0; i < count; ++i) scene.parts.push_back(partOf(shared, i));
  return scene;
}

BenchScene threeInARow(const Mesh& mesh) {
  constexpr double kApart = 1.1, kAway = 4;   // bodies' lengths, from one to the next and from the first to the eye
  BenchScene scene{"row", "three bodies in a row along the view", {}};
  const MeshPointer shared = share(mesh);
  const Box box = boundingBox(mesh);
  const double length = box.max.x - box.min.x;
  // A little off the axis: faces that the row runs along would lie in one plane with those of the next body, and reach through all three.
  const glm::dvec3 along = length * glm::normalize(glm::dvec3(1, 0.017, 0.011));
  for (std::size_t i = 0; i < 3; ++i) scene.parts.push_back(partOf(shared, i, glm::translate(glm::dmat4(1.0), -kApart * double(i) * along)));
  const glm::dvec3 center = box.center(), eye = center + kAway * along;
  scene.camera.camera = {eye.x, eye.y, eye.z, center.x, center.y, center.z};
  return scene;
}

BenchScene stack(unsigned depths, unsigned coplanar) {
  constexpr double kReach = 4;   // wider than the view at the farthest: half its height is 1.2 there
  BenchScene scene{"stack", fmt::format("{} depths of {} coplanar fragments in half of the pixels", depths, coplanar), {}};
  for (unsigned d = 0; d < depths; ++d) {
    const double z = -kStackNear - (kStackFar - kStackNear) * d / depths;
    Mesh mesh;
    mesh.vertices = {{-kReach, -kReach, z}, {0, -kReach, z}, {0, kReach, z}, {-kReach, kReach, z}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    const MeshPointer shared = share(std::move(mesh));
    for (unsigned c = 0; c < coplanar; ++c) scene.parts.push_back(partOf(shared, scene.parts.size()));
  }
  scene.camera.camera = {0, 0, 0, 0, 0, -1};   // at the origin, along -z
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
  if (name == "cut") return cutInThreeWays();
  if (name == "city") return city();
  if (name == "hair") return {"hair", "a ball of hairs", {partOf(share(hairs(kHairs, kHairJoints)), 0)}};
  if (name == "row") return threeInARow(bumpySphere(kSmall, kSmall));
  BenchScene scene = copies(readMesh(name), copyCount, std::filesystem::path(name).stem().string());
  scene.title = copyCount == 1 ? "as it is in its file" : fmt::format("{} coincident copies", copyCount);
  return scene;
}

bool isCoplanar(const std::string& sceneName, std::size_t copyCount) {
  if (sceneName == "cut" || sceneName == "city") return true;
  const auto& names = sceneNames();
  const bool isFile = std::find(names.begin(), names.end(), sceneName) == names.end();
  return copyCount > 1 && (isFile || sceneName == "copies" || sceneName == "turned");
}

View viewOf(const BenchScene& scene, const Box& bounds, int width, int height) {
  CameraOptions camera = scene.camera;
  camera.width = width;
  camera.height = height;
  return copeel::viewOf(camera, bounds);
}

}  // namespace copeel::bench
