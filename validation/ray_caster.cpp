#include "validation/ray_caster.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace copeel::validation {
namespace {

constexpr int kTilePx = 16;
constexpr double kTileMarginPx = 2.0;       // rays are moved by less than a pixel
constexpr double kFlatSine = 1e-9;          // two faces whose normals differ by less are one facet: rounding of a turned quad is 1e-15

// Half the width of the rounding interval of a rational's nearest double, per coordinate.
Vec<Bounded> boundedVertex(const OracleMesh& mesh, std::uint32_t index) {
  if (mesh.exactVertices.empty()) return vecOf<Bounded>(mesh.vertices[index]);
  const ExactPoint& p = mesh.exactVertices[index];
  return {boundedOf(p[0]), boundedOf(p[1]), boundedOf(p[2])};
}

}  // namespace

RayCaster::RayCaster(const std::vector<OracleMesh>& meshes, const View& view) : meshes_(meshes), view_(view) {
  tileColumns_ = (view.width + kTilePx - 1) / kTilePx;
  tileRows_ = (view.height + kTilePx - 1) / kTilePx;
  tiles_.resize(static_cast<std::size_t>(tileColumns_) * tileRows_);
  for (std::uint32_t m = 0; m < meshes_.size(); ++m) addTriangles(m);
  for (std::uint32_t t = 0; t < triangles_.size(); ++t) addToTiles(t);
}

void RayCaster::addTriangles(std::uint32_t mesh) {
  const OracleMesh& source = meshes_[mesh];
  const std::size_t first = triangles_.size();
  for (const glm::uvec3& corners : source.triangles) {
    Triangle t;
    t.mesh = mesh;
    t.corners = corners;
    t.sight = sightOf<Bounded>(view_, {boundedVertex(source, corners.x), boundedVertex(source, corners.y), boundedVertex(source, corners.z)});
    triangles_.push_back(std::move(t));
  }
  markFlatEdges(mesh, first);
}

void RayCaster::markFlatEdges(std::uint32_t mesh, std::size_t first) {
  // The users of each undirected edge, by position.
  const OracleMesh& source = meshes_[mesh];
  using Point = std::array<double, 3>;
  std::map<std::pair<Point, Point>, std::vector<std::pair<std::size_t, int>>> users;
  const auto pointOf = [&](std::uint32_t i) { return Point{source.vertices[i].x + 0.0, source.vertices[i].y + 0.0, source.vertices[i].z + 0.0}; };
  for (std::size_t t = first; t < triangles_.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      const Point p = pointOf(triangles_[t].corners[i]), q = pointOf(triangles_[t].corners[(i + 1) % 3]);
      users[{std::min(p, q), std::max(p, q)}].emplace_back(t, i);
    }
  }

  // An edge of two parallel faces that look the same way bends nothing.
  const auto normalOf = [&](std::size_t t) {
    const glm::uvec3& c = triangles_[t].corners;
    const glm::dvec3 a = source.vertices[c.x];
    return glm::cross(source.vertices[c.y] - a, source.vertices[c.z] - a);
  };
  for (const auto& [edge, list] : users) {
    if (list.size() != 2) continue;
    const glm::dvec3 n = normalOf(list[0].first), m = normalOf(list[1].first);
    if (glm::dot(n, m) <= 0 || glm::length(glm::cross(n, m)) > kFlatSine * glm::length(n) * glm::length(m)) continue;
    for (const auto& [t, i] : list) triangles_[t].sharp[i] = false;
  }
}

void RayCaster::addToTiles(std::uint32_t index) {
  const Triangle& t = triangles_[index];
  double left = 0, right = view_.width, top = 0, bottom = view_.height;

  // Project the corners; a triangle that reaches the eye's plane may be anywhere.
  double u[3], v[3], z[3];
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 p = meshes_[t.mesh].vertices[t.corners[i]] - view_.eye;
    z[i] = glm::dot(p, view_.forward);
    const double scale = view_.perspective ? z[i] : 1.0;
    u[i] = glm::dot(p, view_.right) / (glm::dot(view_.right, view_.right) * scale) + view_.width * 0.5;
    v[i] = glm::dot(p, view_.down) / (glm::dot(view_.down, view_.down) * scale) + view_.height * 0.5;
  }
  const double reach = std::max({std::abs(z[0]), std::abs(z[1]), std::abs(z[2])});
  if (!view_.perspective || std::min({z[0], z[1], z[2]}) > 1e-6 * reach) {
    left = std::max(left, std::min({u[0], u[1], u[2]}) - kTileMarginPx);
    right = std::min(right, std::max({u[0], u[1], u[2]}) + kTileMarginPx);
    top = std::max(top, std::min({v[0], v[1], v[2]}) - kTileMarginPx);
    bottom = std::min(bottom, std::max({v[0], v[1], v[2]}) + kTileMarginPx);
  }
  if (left > right || top > bottom) return;
  for (int row = int(top) / kTilePx; row <= std::min(int(bottom) / kTilePx, tileRows_ - 1); ++row)
    for (int column = int(left) / kTilePx; column <= std::min(int(right) / kTilePx, tileColumns_ - 1); ++column)
      tiles_[static_cast<std::size_t>(row) * tileColumns_ + column].push_back(index);
}

const std::vector<std::uint32_t>& RayCaster::tileOf(const Ray& ray) const {
  const int x = std::clamp(int(std::floor(ray.u + view_.width * 0.5)), 0, view_.width - 1);
  const int y = std::clamp(int(std::floor(ray.v + view_.height * 0.5)), 0, view_.height - 1);
  return tiles_[static_cast<std::size_t>(y / kTilePx) * tileColumns_ + x / kTilePx];
}

Ray RayCaster::rayOf(int x, int y, double du, double dv) const {
  return {x + 0.5 + view_.offset.x - view_.width * 0.5 + du, y + 0.5 + view_.offset.y - view_.height * 0.5 + dv};
}

std::array<Vec<mpq_class>, 3> RayCaster::exactCorners(const Triangle& t) const {
  const OracleMesh& mesh = meshes_[t.mesh];
  return {mesh.exactVertex(t.corners.x), mesh.exactVertex(t.corners.y), mesh.exactVertex(t.corners.z)};
}

const Sight<mpq_class>& RayCaster::exactSight(const Triangle& t) const {
  if (!t.exactSight) t.exactSight = std::make_unique<Sight<mpq_class>>(sightOf<mpq_class>(view_, exactCorners(t)));
  return *t.exactSight;
}

std::uint32_t RayCaster::exactPlane(const Triangle& t) const {
  if (t.exactPlane) return *t.exactPlane;
  // Scale the plane so that its first coefficient that is not zero becomes one: equal planes, equal numbers.
  const auto p = exactCorners(t);
  const Vec<mpq_class> n = validation::cross(Vec<mpq_class>(p[1] - p[0]), Vec<mpq_class>(p[2] - p[0]));
  std::array<mpq_class, 4> key{n[0], n[1], n[2], dot(n, p[0])};
  for (int i = 0; i < 3; ++i) {
    if (sgn(key[i]) == 0) continue;
    const mpq_class scale = key[i];
    for (mpq_class& k : key) k /= scale;
    break;
  }
  t.exactPlane = planeNumbers_.try_emplace(key, std::uint32_t(planeNumbers_.size())).first->second;
  return *t.exactPlane;
}

// The sign of an edge form, never zero unless the edge projects to a point.
std::optional<int> RayCaster::side(const Ray& ray, const Triangle& t, int edge) const {
  const std::optional<int> filtered = signOf(t.sight.edge[edge].at(ray.u, ray.v));
  if (filtered && *filtered != 0) return filtered;
  const Form<mpq_class>& form = exactSight(t).edge[edge];
  if (const int s = sgn(form.at(mpq_class(ray.u), mpq_class(ray.v)))) return s;
  // The ray meets the edge: ask the ray at (u + ε, v + ε²).
  if (const int s = sgn(form.a)) return s;
  if (const int s = sgn(form.b)) return s;
  return std::nullopt;
}

std::optional<Crossing> RayCaster::crossTriangle(const Ray& ray, std::uint32_t index) const {
  // All three edges must agree, the sides of the far ones being asked only then.
  const Triangle& t = triangles_[index];
  const std::optional<int> first = side(ray, t, 0);
  if (!first || side(ray, t, 1) != first || side(ray, t, 2) != first) return std::nullopt;

  Crossing c{t.mesh, index, -*first, {}, nullptr};
  const Bounded top = t.sight.depthTop.at(ray.u, ray.v), bottom = t.sight.depthBottom.at(ray.u, ray.v);
  c.depth = top / bottom;
  std::optional<int> sign = signOf(c.depth);
  if (!std::isfinite(c.depth.error) || !sign) {
    // A face seen edge-on whose plane holds this very ray has no depth of its own.
    const Sight<mpq_class>& exact = exactSight(t);
    if (sgn(exact.depthBottom.at(mpq_class(ray.u), mpq_class(ray.v))) == 0) return std::nullopt;
    c.depth = boundedOf(exactDepth(ray, c));
    sign = sgn(*c.exactDepth);
  }
  if (view_.perspective && *sign <= 0) return std::nullopt;
  return c;
}

const mpq_class& RayCaster::exactDepth(const Ray& ray, const Crossing& c) const {
  if (!c.exactDepth) {
    const Sight<mpq_class>& s = exactSight(triangles_[c.triangle]);
    const mpq_class u(ray.u), v(ray.v);
    c.exactDepth = std::make_shared<const mpq_class>(s.depthTop.at(u, v) / s.depthBottom.at(u, v));
  }
  return *c.exactDepth;
}

int RayCaster::compareDepth(const Ray& ray, const Crossing& a, const Crossing& b) const {
  if (const std::optional<int> sign = signOf(a.depth - b.depth); sign && *sign != 0) return *sign;
  if (exactPlane(triangles_[a.triangle]) == exactPlane(triangles_[b.triangle])) return 0;
  return cmp(exactDepth(ray, a), exactDepth(ray, b));
}

std::vector<Crossing> RayCaster::cross(const Ray& ray) const {
  std::vector<Crossing> out;
  for (const std::uint32_t index : tileOf(ray))
    if (auto c = crossTriangle(ray, index)) out.push_back(std::move(*c));
  std::sort(out.begin(), out.end(), [&](const Crossing& a, const Crossing& b) {
    const int order = compareDepth(ray, a, b);
    return order != 0 ? order < 0 : a.triangle < b.triangle;
  });
  return out;
}

// Whether all corners of one triangle lie within a distance of another's plane. Far above the rounding of doubles, as a declared tolerance is.
bool RayCaster::liesInPlaneOf(const Triangle& t, const Triangle& plane, double tolerance) const {
  const auto corner = [&](const Triangle& of, int i) { return meshes_[of.mesh].vertices[of.corners[i]]; };
  const glm::dvec3 a = corner(plane, 0), n = glm::cross(corner(plane, 1) - a, corner(plane, 2) - a);
  for (int i = 0; i < 3; ++i)
    if (!(std::abs(glm::dot(n, corner(t, i) - a)) <= tolerance * glm::length(n))) return false;
  return true;
}

bool RayCaster::sameDepth(const Ray& ray, const Crossing& near, const Crossing& far, double tolerance) const {
  if (compareDepth(ray, near, far) == 0) return true;
  const Triangle &a = triangles_[near.triangle], &b = triangles_[far.triangle];
  return tolerance > 0 && (liesInPlaneOf(a, b, tolerance) || liesInPlaneOf(b, a, tolerance));
}

double RayCaster::cosine(const Ray& ray, std::uint32_t triangle) const {
  const Sight<Bounded>& s = triangles_[triangle].sight;
  glm::dvec3 direction = view_.forward;
  if (view_.perspective) direction += ray.u * view_.right + ray.v * view_.down;
  return std::abs(s.depthBottom.at(ray.u, ray.v).value) / (std::sqrt(s.normalSquared.value) * glm::length(direction));
}

double RayCaster::planeDepth(const Ray& ray, std::uint32_t triangle) const {
  const Sight<Bounded>& s = triangles_[triangle].sight;
  return s.depthTop.at(ray.u, ray.v).value / s.depthBottom.at(ray.u, ray.v).value;
}

bool RayCaster::nearEdge(const Ray& ray, double radius) const {
  for (const std::uint32_t index : tileOf(ray)) {
    const Triangle& t = triangles_[index];
    double distance[3];   // pixels, positive inside
    const double turn = t.sight.depthBottom.at(ray.u, ray.v).value < 0 ? -1 : 1;
    for (int i = 0; i < 3; ++i) {
      const Form<Bounded>& e = t.sight.edge[i];
      distance[i] = turn * e.at(ray.u, ray.v).value / std::hypot(e.a.value, e.b.value);
    }
    if (!(std::min({distance[0], distance[1], distance[2]}) >= -radius)) continue;
    if (view_.perspective && !(planeDepth(ray, index) > 0)) continue;
    for (int i = 0; i < 3; ++i)
      if (t.sharp[i] && std::abs(distance[i]) <= radius) return true;
  }
  return false;
}

}  // namespace copeel::validation
