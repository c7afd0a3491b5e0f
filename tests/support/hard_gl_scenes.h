// The catalogue's hard cases 2 to 12 for the methods of the gl back end, as far as glScenes() and coplanarScenes() lack them: each a few triangles and a
// small image, named by what is hard. Several sizes of one hazard stand side by side in one scene, since every scene is a context of its own.
#pragma once

#include <cmath>
#include <vector>

#include "tests/support/coplanar_scenes.h"

namespace copeel::test {

// Unit squares facing up, the i-th of a row at x = 1.25 i.
inline glm::dmat4 inRow(int i, double z = 0) { return translation({1.25 * i, 0, z}); }

inline View overRow(int count, int height = 8) {
  return lookAt({0.625 * count, 0.51, 30}, {0.625 * count, 0.51, 0}, 8 * count, height, 0.1563, false);
}

// 2: one plane as a quad, as a fan of 1,000 slivers, and turned over.
inline NamedScene fanOfSlivers() {
  const Mesh square = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const MeshPointer fan = share(fanSquare(0, 500));
  const glm::dmat4 here(1.0);
  return {"1000 slivers", Scene({{share(square), here}, {fan, here}, {share(flipped(square)), here}}), overRow(1, 12)};
}

// 3: so many copies of one box in one place, and of its triangles in other orders.
inline NamedScene manyCopies() {
  const Mesh cube = box({0, 0, 0}, {1, 1, 1}, false);
  const MeshPointer plain = share(cube);
  std::vector<MeshPointer> permutedOnes;
  for (unsigned seed = 0; seed < 8; ++seed) permutedOnes.push_back(share(permuted(cube, seed)));
  std::vector<Object> objects;
  const int counts[] = {2, 3, 7, 8, 9, 32, 64};
  for (int i = 0; i < 7; ++i) {
    for (int copy = 0; copy < counts[i]; ++copy) objects.push_back({copy % 2 ? permutedOnes[static_cast<std::size_t>(copy) % 8] : plain, inRow(i)});
  }
  return {"2 to 64 copies", Scene(std::move(objects)), overRow(7)};
}

// 5: pairs of faces 1e-1 … 1e-15 apart, all tilted alike.
inline NamedScene nearCoincident(double degrees) {
  const MeshPointer square = share(quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}));
  std::vector<Object> objects;
  for (int i = 0; i < 15; ++i) {
    for (const double z : {0.0, std::pow(10.0, -1 - i)}) objects.push_back({square, inRow(i) * rotation({degrees, 0, 0}) * translation({0, 0, z})});
  }
  return {degrees == 0 ? "gaps" : "tilted gaps", Scene(std::move(objects)), overRow(15)};
}

// 8: tops of boxes seen at 1e-3 … 1e-9 rad, one whose plane holds the eye, one seen from below. The boxes stand behind one another.
inline NamedScene edgeOn() {
  const MeshPointer cube = share(box({-1, -1, -1}, {1, 1, 0}));
  std::vector<Object> objects;
  const double angles[] = {0, 1e-3, 1e-5, 1e-7, 1e-9, -1e-9, -1e-3};
  for (int i = 0; i < 7; ++i) objects.push_back({cube, translation({-3.0 * i, 0.3 * i, -angles[i] * (10 + 3 * i)})});
  return {"edge-on", Scene(std::move(objects)), lookAt({10, 0.1, 0}, {0, 0, 0}, 48, 24, 0.01)};
}

// 9: planes through one line, seen across it and along it.
inline NamedScene pencilOfPlanes(bool along) {
  const MeshPointer blade = share(quad({-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}));
  std::vector<Object> objects;
  for (int i = 0; i < 100; ++i) objects.push_back({blade, rotation({1.8 * i, 0, 0})});
  return {along ? "pencil along" : "pencil across", Scene(std::move(objects)),
          along ? lookAt({5, 0.01, 0.02}, {0, 0, 0}, 12, 12, 0.04) : lookAt({0.3, 4, 3}, {0, 0, 0}, 16, 12, 0.03)};
}

// 10: a speck before the eye, a part, and a wall a million away.
inline NamedScene longRange() {
  const Mesh wall = quad({-1e6, -1e6, -1e6}, {1e6, -1e6, -1e6}, {1e6, 1e6, -1e6}, {-1e6, 1e6, -1e6});
  const MeshPointer cube = share(box({-1, -1, -1}, {1, 1, 1}));
  const glm::dmat4 here(1.0), part = translation({0, 0, -10});
  return {"1e-3 to 1e6", Scene({{cube, translation({1e-4, 0, -2e-3}) * scaling(glm::dvec3(5e-4))}, {cube, part}, {cube, part}, {share(wall), here}, {share(permuted(wall, 1)), here}}),
          lookAt({0, 0, 0}, {0, 0, -10}, 48, 36, 0.02)};
}

// 11: so many coplanar fragments about the sizes of small integers.
inline NamedScene manyCoplanar() {
  const Mesh square = quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  std::vector<Object> objects;
  for (int i = 0; i < 3; ++i) {
    Mesh all = square;
    all.triangles.clear(), all.facets.clear();
    for (int copy = 0; copy < 255 + i; ++copy) all.triangles.insert(all.triangles.end(), square.triangles.begin(), square.triangles.end());
    objects.push_back({share(std::move(all)), inRow(i)});
  }
  return {"255 to 257 coplanar", Scene(std::move(objects)), overRow(3)};
}

// 12: the eye inside a ball and a box, on a face of the box, and at its vertex.
inline NamedScene eyeIn(const char* name, const glm::dvec3& eye) {
  const MeshPointer cube = share(box({-1, -1, -1}, {1, 1, 1}));
  const glm::dmat4 here(1.0);
  return {name, Scene({{share(sphere(3, 13, 7)), here}, {cube, here}, {cube, here}, {cube, translation({3, 0, 0})}}),
          lookAt(eye, eye + glm::dvec3(1, 0.13, 0.07), 48, 36, 0.04)};
}

inline std::vector<NamedScene> hardGlScenes() {
  return {fanOfSlivers(), manyCopies(), nearCoincident(0), nearCoincident(20), edgeOn(), pencilOfPlanes(false), pencilOfPlanes(true), longRange(), manyCoplanar(),
          eyeIn("eye inside", {0.2, 0.1, -0.3}), eyeIn("eye on a face", {1, 0.2, 0.3}), eyeIn("eye at a vertex", {-1, -1, -1})};
}

// 10: images of extreme shape.
inline NamedScene extremeImage(int width, int height) {
  View view = lookAt({3, 2, 4}, {0, 0, 0}, width, height, 0.01);
  // As many pixels as there are, they span the scene both ways.
  view.right *= 300.0 / width, view.down *= 300.0 / height;
  const MeshPointer ball = share(sphere(1, 13, 7));
  return {std::to_string(width) + "x" + std::to_string(height), Scene({{ball, glm::dmat4(1.0)}, {ball, glm::dmat4(1.0)}, {ball, translation({0.3, 0, 0})}}), view};
}

}  // namespace copeel::test
