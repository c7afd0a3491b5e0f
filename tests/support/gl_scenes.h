// Scenes for the methods of the gl back end: what coplanarity, depth and emptiness can do to them, in a few triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>

#include "core/scene/scene.h"
#include "tests/support/meshes.h"
#include "tests/support/views.h"

namespace copeel::test {

struct GlScene {
  std::string name;
  Scene scene;
  View view;
};

inline Scene copiesOf(const MeshPointer& mesh, int count, const glm::dvec3& step = {0, 0, 0}) {
  std::vector<Object> objects;
  for (int i = 0; i < count; ++i) objects.push_back({mesh, translation(step * double(i))});
  return Scene(std::move(objects));
}

// The same surface, its triangles in another order and each begun at another corner.
inline Mesh shuffled(Mesh mesh) {
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  for (glm::uvec3& t : mesh.triangles) t = {t.y, t.z, t.x};
  // Facets are numbered in the order of their triangles.
  std::reverse(mesh.facets.begin(), mesh.facets.end());
  const auto last = mesh.facets.empty() ? 0 : mesh.facets.front();
  for (auto& facet : mesh.facets) facet = last - facet;
  return mesh;
}

inline Mesh squareAt(double z) { return quad({0, 0, z}, {1, 0, z}, {1, 1, z}, {0, 1, z}); }

// Towers of unit boxes that share walls.
inline Scene voxelCity() {
  const MeshPointer cube = share(box({0, 0, 0}, {1, 1, 1}));
  std::vector<Object> objects;
  for (int x = 0; x < 3; ++x) {
    for (int y = 0; y < 3; ++y) {
      for (int z = 0; z <= (x * 2 + y) % 3; ++z) objects.push_back({cube, translation({double(x), double(y), double(z)})});
    }
  }
  return Scene(std::move(objects));
}

// Triangles in a plane that the eye at (1, 2, 3) lies in, before a ball: what the rasterizer finds of them is no fragment.
inline Scene sheetThroughTheEye() {
  Mesh sheet;
  std::uint32_t seed = 1;
  const auto next = [&] { return double((seed = seed * 1664525u + 1013904223u) >> 16) / 65536 * 800 - 400; };
  for (std::uint32_t i = 0; i < 3 * 400; ++i) {
    const double x = std::round(next()), y = std::round(next());
    sheet.vertices.emplace_back(x, y, 6 - x - y);
    if (i % 3 == 0) sheet.triangles.emplace_back(i, i + 1, i + 2);
  }
  return Scene({{share(std::move(sheet)), glm::dmat4(1.0)}, {share(sphere(20, 17, 9)), translation({-50, 23, 33})}});
}

inline View above(int width, int height, double pixel = 0.03) { return lookAt({0.5, 0.5, 20}, {0.5, 0.5, 0}, width, height, pixel, false); }

// Sheets that each begin a pixel further right, for above(kStairs, rows, 1): pixel x of its two middle rows has x + 1 fragments, up to three of one depth. Sheet i
// is of primitives 2 i and 2 i + 1, and lies at heightOfSheet(i).
constexpr int kStairs = 140;
inline double heightOfSheet(int i) { return 0.01 * (i * 7 % 50); }

inline Mesh stairs() {
  Mesh all;
  for (int i = 0; i < kStairs; ++i) {
    const double x = 0.5 + i - kStairs / 2, z = heightOfSheet(i);
    const int first = 4 * i;
    for (const glm::dvec3 corner : {glm::dvec3(x, -0.4, z), glm::dvec3(kStairs, -0.4, z), glm::dvec3(kStairs, 1.4, z), glm::dvec3(x, 1.4, z)}) all.vertices.push_back(corner);
    all.triangles.emplace_back(first, first + 1, first + 2);
    all.triangles.emplace_back(first, first + 2, first + 3);
  }
  return all;
}

inline std::vector<GlScene> glScenes() {
  const MeshPointer ball = share(sphere(1, 17, 9)), cube = share(box({-0.7, -0.7, -0.7}, {0.7, 0.7, 0.7}));
  const glm::dmat4 here(1.0);
  const View aside = lookAt({3, 2, 4}, {0, 0, 0}, 64, 48, 0.02);
  std::vector<GlScene> scenes;
  scenes.push_back({"5 coincident balls", copiesOf(ball, 5), aside});
  scenes.push_back({"shuffled twin", Scene({{ball, here}, {share(shuffled(sphere(1, 17, 9))), here}}), aside});
  scenes.push_back({"fan against quad", Scene({{share(fanSquare(0, 5)), here}, {share(squareAt(0)), here}}), above(64, 48)});
  scenes.push_back({"voxel city", voxelCity(), lookAt({8, 6, 7}, {1.5, 1.5, 1}, 64, 48, 0.015)});
  scenes.push_back({"interpenetrating", Scene({{ball, here}, {cube, here}, {cube, rotation({0, 0, 90})}, {cube, rotation({0, 30, 0})}}), aside});
  scenes.push_back({"box in box", Scene({{cube, here}, {cube, scaling({0.5, 0.5, 0.5})}}), aside});
  scenes.push_back({"one triangle", Scene({{share(Mesh{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {}, {}}), here}}), above(64, 48)});
  scenes.push_back({"nothing", Scene(std::vector<Object>{}), above(64, 48)});
  scenes.push_back({"one pixel", copiesOf(ball, 3), lookAt({3, 2, 4}, {0, 0, 0}, 1, 1, 0.5)});
  scenes.push_back({"wide", copiesOf(ball, 3), lookAt({3, 2, 4}, {0, 0, 0}, 301, 2, 0.005)});
  scenes.push_back({"300 layers", copiesOf(share(squareAt(0)), 300, {0, 0, 0.01}), above(32, 24, 0.06)});
  scenes.push_back({"300 coplanar", copiesOf(share(squareAt(0)), 300), above(32, 24, 0.06)});
  scenes.push_back({"sheet through the eye", sheetThroughTheEye(), lookAt({1, 2, 3}, {-50, 23, 33}, 64, 48, 0.0083)});
  return scenes;
}

}  // namespace copeel::test
