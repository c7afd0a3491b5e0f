// Scenes whose surfaces lie on one another, for the methods that have to keep them apart: small, and looked at in small images.
#pragma once

#include <algorithm>
#include <random>
#include <string>

#include "core/scene/scene.h"
#include "tests/support/meshes.h"
#include "tests/support/views.h"

namespace copeel::test {

struct NamedScene {
  std::string name;
  Scene scene;
  View view;
};

inline Scene copies(const MeshPointer& mesh, std::size_t count) { return Scene(std::vector<Object>(count, Object{mesh, glm::dmat4(1.0)})); }

// The same surface: triangles in another order, each beginning at another corner.
inline Mesh permuted(Mesh mesh, unsigned seed) {
  std::mt19937 random(seed);
  mesh.facets.clear();
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random);
  for (glm::uvec3& t : mesh.triangles) {
    for (unsigned turns = random() % 3; turns > 0; --turns) t = {t.y, t.z, t.x};
  }
  return mesh;
}

// Unit cubes side by side, every second one of a row a layer higher: faces meet by the side and the edge.
inline Scene voxelCity(int size) {
  const MeshPointer cube = share(box({0, 0, 0}, {1, 1, 1}));
  std::vector<Object> objects;
  for (int x = 0; x < size; ++x) {
    for (int y = 0; y < size; ++y) {
      for (int z = 0; z <= (x + y) % 2; ++z) objects.push_back({cube, translation({x - 0.5 * size, y - 0.5 * size, z})});
    }
  }
  return Scene(std::move(objects));
}

// Squares one behind another along z, `fold` of them at each depth; one mesh.
inline Scene sheets(int depths, int fold) {
  Mesh all;
  for (int z = 0; z < depths; ++z) {
    const Mesh sheet = quad({-1, -1, -0.01 * z}, {1, -1, -0.01 * z}, {1, 1, -0.01 * z}, {-1, 1, -0.01 * z});
    for (int i = 0; i < fold; ++i) all = joined(all, sheet);
  }
  return Scene({{share(std::move(all)), glm::dmat4(1.0)}});
}

inline std::vector<NamedScene> coplanarScenes() {
  const Mesh ball = sphere(1, 13, 7), cube = box({-1, -1, -1}, {1, 1, 1});
  const MeshPointer whole = share(cube), inner = share(box({-0.5, -0.5, -1}, {0.5, 0.5, 0.5}));
  const MeshPointer fan = share(fanSquare(0, 5)), square = share(quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}));
  Mesh triangle;
  triangle.vertices = {{-1, -1, 0}, {1, -1, 0.5}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  const glm::dmat4 here(1.0);
  const View view = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02), above = lookAt({0.1, 0.2, 5}, {0, 0, 0}, 8, 6, 0.06);
  View one = view, wide = view;
  one.width = one.height = 1;
  wide.width = 300, wide.height = 3;
  return {
      {"copies", copies(share(ball), 9), view},
      {"permuted", Scene({{share(ball), here}, {share(permuted(ball, 1)), here}, {share(permuted(ball, 2)), here}}), view},
      {"inside out", Scene({{share(ball), here}, {share(flipped(ball)), here}, {share(flipped(permuted(ball, 3))), here}}), view},
      {"fan on square", Scene({{fan, here}, {square, here}, {fan, here}}), view},
      {"voxel city", voxelCity(4), lookAt({5, 4, 6}, {0, 0, 0}, 64, 48, 0.02)},
      {"orthographic city", voxelCity(3), lookAt({5, 4, 6}, {0, 0, 0}, 64, 48, 0.1, false)},
      {"interpenetrating", Scene({{whole, here}, {whole, rotation({20, 30, 40})}, {share(ball), translation({0.3, 0, 0})}}), view},
      {"box in box", Scene({{whole, here}, {inner, here}, {inner, rotation({0, 0, 90})}}), view},
      {"one triangle", Scene({{share(triangle), here}}), view},
      {"empty", Scene(), view},
      {"one pixel", copies(whole, 3), one},
      {"wide", copies(whole, 3), wide},
      {"300 layers", sheets(300, 1), above},
      {"300 at one depth", sheets(1, 300), above},
      {"9 at each of 7 depths", sheets(7, 9), above},
  };
}

}  // namespace copeel::test
