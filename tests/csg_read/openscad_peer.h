// openscad itself as the judge: models are given to it, and what it exports is read back.
#pragma once

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string>
#include <array>
#include <tuple>
#include <vector>

#include "apps/csg/process.h"
#include "core/scene/mesh.h"

namespace copeel::csg::test {

inline bool hasOpenscad() { return std::system("openscad -v >/dev/null 2>&1") == 0; }

#define SKIP_WITHOUT_OPENSCAD() \
  if (!::copeel::csg::test::hasOpenscad()) GTEST_SKIP() << "openscad is not installed"

using FloatPoint = std::array<float, 3>;
using FloatTriangle = std::array<FloatPoint, 3>;

inline void writeFile(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

inline std::string readFile(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

// The triangles openscad exports of a model as binary STL; none where it exports nothing.
inline std::vector<FloatTriangle> exportedBy(const std::string& scad) {
  const TemporaryFolder folder(std::filesystem::temp_directory_path().string());
  writeFile(folder.path() + "/a.scad", scad);
  std::vector<Command> commands(1);
  commands[0].arguments = {"openscad", "--export-format", "binstl", "-o", folder.path() + "/a.stl", folder.path() + "/a.scad"};
  commands[0].logPath = folder.path() + "/log";
  runAll(commands, 1);
  const std::string bytes = readFile(folder.path() + "/a.stl");
  std::vector<FloatTriangle> triangles;
  for (std::size_t at = 84; at + 50 <= bytes.size(); at += 50) {
    FloatTriangle t;
    std::memcpy(t.data(), bytes.data() + at + 12, 36);
    for (FloatPoint& p : t) {
      for (float& x : p) x += 0.0f;
    }
    triangles.push_back(t);
  }
  return triangles;
}

// The .csg openscad makes of a model.
inline std::string csgBy(const std::string& scad) {
  const TemporaryFolder folder(std::filesystem::temp_directory_path().string());
  writeFile(folder.path() + "/a.scad", scad);
  std::vector<Command> commands(1);
  commands[0].arguments = {"openscad", "-o", folder.path() + "/a.csg", folder.path() + "/a.scad"};
  commands[0].logPath = folder.path() + "/log";
  runAll(commands, 1);
  return readFile(folder.path() + "/a.csg");
}

inline std::vector<FloatTriangle> trianglesOf(const Mesh& mesh) {
  std::vector<FloatTriangle> triangles;
  for (const glm::uvec3& t : mesh.triangles) {
    FloatTriangle triangle;
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3& p = mesh.vertices[t[i]];
      triangle[static_cast<std::size_t>(i)] = {static_cast<float>(p.x) + 0.0f, static_cast<float>(p.y) + 0.0f, static_cast<float>(p.z) + 0.0f};
    }
    triangles.push_back(triangle);
  }
  return triangles;
}

inline std::set<FloatPoint> pointsOf(const std::vector<FloatTriangle>& triangles) {
  std::set<FloatPoint> points;
  for (const FloatTriangle& t : triangles) points.insert(t.begin(), t.end());
  return points;
}

inline double volumeOf(const std::vector<FloatTriangle>& triangles) {
  double volume = 0;
  for (const FloatTriangle& t : triangles) {
    const glm::dvec3 a(t[0][0], t[0][1], t[0][2]), b(t[1][0], t[1][1], t[1][2]), c(t[2][0], t[2][1], t[2][2]);
    volume += glm::dot(a, glm::cross(b, c)) / 6;
  }
  return volume;
}

// The same triangles, whichever corner comes first.
inline std::set<FloatTriangle> normalized(const std::vector<FloatTriangle>& triangles) {
  std::set<FloatTriangle> result;
  for (FloatTriangle t : triangles) {
    while (t[1] < t[0] || t[2] < t[0]) t = {t[1], t[2], t[0]};
    result.insert(t);
  }
  return result;
}

// Directed edges without an opposite one.
inline std::size_t openEdgeCount(const std::vector<FloatTriangle>& triangles) {
  std::multiset<std::pair<FloatPoint, FloatPoint>> edges;
  for (const FloatTriangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const FloatPoint &a = t[i], &b = t[(i + 1) % 3];
      const auto opposite = edges.find({b, a});
      if (opposite != edges.end()) edges.erase(opposite);
      else edges.insert({a, b});
    }
  }
  return edges.size();
}

}  // namespace copeel::csg::test
