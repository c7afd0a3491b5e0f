#include "apps/bench/bodies.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include <glm/geometric.hpp>

namespace copeel::bench {
namespace {

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

Mesh hairball(int count, int joints) {
  constexpr double kLength = 3.6, kRadius = 0.0081, kWander = 2.2, kSteerFrom = 0.85, kSteer = 12;   // of a hair, in radii of the ball
  constexpr unsigned kSides = 6;
  Mesh mesh;
  std::mt19937 random(11);
  const auto uniform = [&] { return double(random()) / 4294967296.0 * 2 - 1; };
  const auto anyVector = [&] { return glm::dvec3(uniform(), uniform(), uniform()) + glm::dvec3(1e-6, 0, 0); };
  const double step = kLength / joints;
  for (int h = 0; h < count; ++h) {
    glm::dvec3 at = 0.55 * anyVector(), along = glm::normalize(anyVector()), turn = glm::normalize(anyVector());
    glm::dvec3 side = glm::normalize(glm::cross(along, std::abs(along.x) < 0.9 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0)));
    const auto base = static_cast<unsigned>(mesh.vertices.size());
    for (int j = 0; j <= joints; ++j) {
      const glm::dvec3 up = glm::cross(along, side);
      for (unsigned s = 0; s < kSides; ++s) {
        const double angle = 2 * std::numbers::pi * s / kSides;
        mesh.vertices.push_back(at + kRadius * (std::cos(angle) * side + std::sin(angle) * up));
      }
      // The axis it turns about wanders; near the ball's surface it is steered inwards.
      turn = glm::normalize(turn + 0.35 * anyVector());
      const double radius = glm::length(at);
      along = glm::normalize(along + kWander * step * glm::cross(turn, along) - at * (kSteer * step * std::max(radius - kSteerFrom, 0.0) / std::max(radius, kSteerFrom)));
      at += step * along;
      side = glm::normalize(side - along * glm::dot(side, along));
    }
    for (unsigned j = 0; j < unsigned(joints); ++j) {
      for (unsigned s = 0; s < kSides; ++s) {
        const unsigned a = base + kSides * j + s, b = base + kSides * j + (s + 1) % kSides;
        mesh.triangles.emplace_back(a, b, b + kSides);
        mesh.triangles.emplace_back(a, b + kSides, a + kSides);
      }
    }
  }
  return mesh;
}

}  // namespace copeel::bench
