// Parts and pictures of `copeel oit` for tests.
#pragma once

#include <random>
#include <utility>
#include <vector>

#include "apps/oit/render_oit.h"
#include "tests/support/meshes.h"

namespace copeel::test {

inline oit::Part part(Mesh mesh, const glm::vec4& color, const glm::dmat4& worldFromObject = glm::dmat4(1)) {
  return {share(std::move(mesh)), color, {}, worldFromObject};
}

struct OitDrawing {
  oit::Frame frame;
  Stats stats;
};

// Everything a frame can hold, unlit on black unless `options` says otherwise.
inline oit::RenderOptions unlit() {
  oit::RenderOptions options;
  options.lit = false;
  options.background = {0, 0, 0};
  return options;
}

inline OitDrawing drawParts(const std::vector<oit::Part>& parts, const View& view, oit::RenderOptions options = unlit()) {
  options.wantFloats = options.wantDepth = options.wantIds = options.wantLayers = options.wantCoplanar = true;
  oit::Renderer renderer(parts, options);
  OitDrawing drawing;
  drawing.frame = renderer.draw(view);
  drawing.stats = renderer.stats();
  return drawing;
}

// The same triangles in another order, each beginning with another of its corners.
inline Mesh shuffled(Mesh mesh, unsigned seed) {
  std::mt19937 random(seed);
  for (std::size_t i = mesh.triangles.size(); i > 1; --i) std::swap(mesh.triangles[i - 1], mesh.triangles[random() % i]);
  for (glm::uvec3& t : mesh.triangles) {
    for (unsigned turns = random() % 3; turns > 0; --turns) t = {t.y, t.z, t.x};
  }
  mesh.facets.clear();
  return mesh;
}

// A sphere with bumps: curved, self-hiding, no two faces in one plane but by chance.
inline Mesh bumpySphere(double radius, unsigned columns, unsigned rows) {
  Mesh mesh = sphere(radius, columns, rows);
  for (glm::dvec3& p : mesh.vertices) p *= 1 + 0.25 * std::sin(5 * p.x / radius) * std::cos(4 * p.y / radius + 1) * std::sin(3 * p.z / radius + 2);
  return mesh;
}

// A tube along a (2, 3) torus knot: up to a dozen layers deep.
inline Mesh torusKnot(double size, unsigned steps, unsigned sides) {
  Mesh mesh;
  const auto at = [&](double t) { return size * glm::dvec3((2 + std::cos(3 * t)) * std::cos(2 * t), (2 + std::cos(3 * t)) * std::sin(2 * t), std::sin(3 * t)); };
  for (unsigned i = 0; i < steps; ++i) {
    const double t = 2 * std::numbers::pi * i / steps;
    const glm::dvec3 center = at(t), along = glm::normalize(at(t + 1e-4) - at(t - 1e-4));
    const glm::dvec3 across = glm::normalize(glm::cross(along, glm::dvec3(0, 0, 1))), up = glm::cross(across, along);
    for (unsigned k = 0; k < sides; ++k) {
      const double angle = 2 * std::numbers::pi * k / sides;
      mesh.vertices.push_back(center + 0.5 * size * (std::cos(angle) * across + std::sin(angle) * up));
    }
  }
  for (unsigned i = 0; i < steps; ++i) {
    for (unsigned k = 0; k < sides; ++k) {
      const unsigned a = i * sides + k, b = i * sides + (k + 1) % sides, c = (i + 1) % steps * sides + k, d = (i + 1) % steps * sides + (k + 1) % sides;
      mesh.triangles.emplace_back(a, b, d);
      mesh.triangles.emplace_back(a, d, c);
    }
  }
  return mesh;
}

}  // namespace copeel::test
