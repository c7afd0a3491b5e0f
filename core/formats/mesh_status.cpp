// What is notable about a mesh. Vertices become one where their positions are equal to the bit (-0 is 0); edges and triangles are then counted
// in buckets of their lowest position, so that each is compared with its neighbours only. O(n) but for the sorting inside a bucket.
// Triangles with two corners in one place bound nothing (their edges cancel): they count as degenerate and have no say in edges.
#include <gmpxx.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include <glm/geometric.hpp>

#include "core/formats/read_mesh.h"

namespace copeel {
namespace {

constexpr double kUnitRoundoff = 1.1102230246251565e-16;  // 2^-53

std::uint64_t hashOf(const glm::dvec3& p) {
  // Adding 0 turns -0 into 0. The multipliers are odd and random; the shift brings the well-mixed upper bits down.
  const std::uint64_t x = std::bit_cast<std::uint64_t>(p.x + 0.0), y = std::bit_cast<std::uint64_t>(p.y + 0.0),
                      z = std::bit_cast<std::uint64_t>(p.z + 0.0);
  std::uint64_t h = x * 0x9e3779b97f4a7c15u;
  h = (h ^ (h >> 32) ^ y) * 0xc2b2ae3d27d4eb4fu;
  h = (h ^ (h >> 32) ^ z) * 0xd6e8feb86659fd93u;
  return h ^ (h >> 32);
}

// For each vertex, the first vertex at its position.
std::vector<std::uint32_t> firstAtPosition(const std::vector<glm::dvec3>& vertices) {
  constexpr std::uint32_t kFree = 0xffffffff;
  const std::size_t slotCount = std::bit_ceil(2 * vertices.size() + 1);
  std::vector<std::uint32_t> slots(slotCount, kFree), first(vertices.size());
  for (std::uint32_t v = 0; v < vertices.size(); ++v) {
    std::size_t slot = hashOf(vertices[v]) & (slotCount - 1);
    while (slots[slot] != kFree && vertices[slots[slot]] != vertices[v]) slot = (slot + 1) & (slotCount - 1);
    if (slots[slot] == kFree) slots[slot] = v;
    first[v] = slots[slot];
  }
  return first;
}

// Items filed under a key below keyCount, sorted within each bucket.
template <class Item>
class Buckets {
 public:
  explicit Buckets(std::size_t keyCount) : start_(keyCount + 1, 0) {}
  void count(std::uint32_t key) { ++start_[key]; }
  void allocate() {
    std::uint64_t sum = 0;
    for (std::uint64_t& start : start_) start = sum += start;
    items_.resize(sum);
  }
  // Buckets fill from their ends, so that start_ is right when all items are in.
  void put(std::uint32_t key, const Item& item) { items_[--start_[key]] = item; }
  template <class Visit>
  void forEachSorted(Visit visit) {
    for (std::size_t key = 0; key + 1 < start_.size(); ++key) {
      const auto begin = items_.begin() + start_[key], end = items_.begin() + start_[key + 1];
      std::sort(begin, end);
      visit(begin, end);
    }
  }

 private:
  std::vector<std::uint64_t> start_;
  std::vector<Item> items_;
};

// Calls visit(first, last) for each run of items that `same` holds equal.
template <class Iterator, class Same, class Visit>
void forEachRun(Iterator begin, Iterator end, Same same, Visit visit) {
  while (begin != end) {
    Iterator stop = begin + 1;
    while (stop != end && same(*begin, *stop)) ++stop;
    visit(begin, stop);
    begin = stop;
  }
}

bool hasTwoCornersInOnePlace(const glm::uvec3& t) { return t.x == t.y || t.y == t.z || t.z == t.x; }

void countEdges(const std::vector<glm::uvec3>& triangles, std::size_t vertexCount, MeshStatus& status) {
  // Twice the other end of the edge, plus one if the triangle runs from the higher end to the lower.
  Buckets<std::uint64_t> edges(vertexCount);
  const auto forEachEdge = [&](auto visit) {
    for (const glm::uvec3& t : triangles) {
      if (hasTwoCornersInOnePlace(t)) continue;
      for (int i = 0; i < 3; ++i) visit(t[i], t[(i + 1) % 3]);
    }
  };
  forEachEdge([&](std::uint32_t a, std::uint32_t b) { edges.count(std::min(a, b)); });
  edges.allocate();
  forEachEdge([&](std::uint32_t a, std::uint32_t b) {
    edges.put(std::min(a, b), 2 * std::uint64_t{std::max(a, b)} + (a > b));
  });
  status.closed = true;
  const auto countEdge = [&](auto begin, auto end) {
    const auto faces = end - begin;
    const auto backward = std::count_if(begin, end, [](std::uint64_t e) { return e & 1; });
    status.boundaryEdgeCount += faces == 1;
    status.nonManifoldEdgeCount += faces > 2;
    status.inconsistentEdgeCount += faces == 2 && backward != 1;
    status.closed = status.closed && 2 * backward == faces;
  };
  edges.forEachSorted([&](auto begin, auto end) {
    forEachRun(
        begin, end, [](std::uint64_t a, std::uint64_t b) { return a / 2 == b / 2; }, countEdge);
  });
}

std::uint64_t duplicateCount(const std::vector<glm::uvec3>& triangles, std::size_t vertexCount) {
  Buckets<std::pair<std::uint32_t, std::uint32_t>> buckets(vertexCount);
  const auto sorted = [](glm::uvec3 t) {
    if (t.x > t.y) std::swap(t.x, t.y);
    if (t.y > t.z) std::swap(t.y, t.z);
    if (t.x > t.y) std::swap(t.x, t.y);
    return t;
  };
  for (const glm::uvec3& t : triangles) buckets.count(sorted(t).x);
  buckets.allocate();
  for (const glm::uvec3& t : triangles) {
    const glm::uvec3 s = sorted(t);
    buckets.put(s.x, {s.y, s.z});
  }
  std::uint64_t duplicates = 0;
  buckets.forEachSorted([&](auto begin, auto end) {
    forEachRun(begin, end, std::equal_to<>(), [&](auto first, auto last) { duplicates += last - first - 1; });
  });
  return duplicates;
}

bool isCollinearExactly(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  std::array<mpq_class, 3> u, v;
  for (int i = 0; i < 3; ++i) {
    u[i] = mpq_class(b[i]) - mpq_class(a[i]);
    v[i] = mpq_class(c[i]) - mpq_class(a[i]);
  }
  return u[0] * v[1] == u[1] * v[0] && u[1] * v[2] == u[2] * v[1] && u[2] * v[0] == u[0] * v[2];
}

// Zero area, exactly: the doubles decide when one component of the cross product exceeds its error, rationals otherwise.
bool isDegenerate(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  if (a == b || b == c || c == a) return true;
  const glm::dvec3 u = b - a, v = c - a;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const double left = u[i] * v[j], right = u[j] * v[i];
    // Two differences, a product each and one more difference: below 6 unit roundoffs of the products, unless one has left the normal range.
    const double error = 6 * kUnitRoundoff * (std::abs(left) + std::abs(right)) + std::numeric_limits<double>::min();
    if (std::abs(left - right) > error && std::isfinite(error)) return false;
  }
  return isCollinearExactly(a, b, c);
}

// Six times the enclosed volume, or 0 when rounding could have made it. Relative to the middle and extent of the mesh, so nothing overflows.
double signedVolume(const Mesh& mesh) {
  const Box box = boundingBox(mesh);
  const glm::dvec3 middle = box.min * 0.5 + box.max * 0.5, half = box.max * 0.5 - box.min * 0.5;
  const double extent = std::max({half.x, half.y, half.z});
  if (!(extent > 0)) return 0;
  double sum = 0, size = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    std::array<glm::dvec3, 3> p;
    for (int i = 0; i < 3; ++i) p[i] = (mesh.vertices[t[i]] - middle) / extent;
    const double volume = glm::dot(p[0], glm::cross(p[1], p[2]));
    sum += volume;
    size += std::abs(volume);
  }
  const double error = kUnitRoundoff * 16 * static_cast<double>(mesh.triangles.size()) * (size + 1);
  return std::abs(sum) > error ? sum : 0;
}

std::uint64_t unreferencedCount(const Mesh& mesh) {
  std::vector<bool> used(mesh.vertices.size(), false);
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = true;
  return static_cast<std::uint64_t>(std::count(used.begin(), used.end(), false));
}

// "1 boundary edge", "12 boundary edges".
std::string counted(std::uint64_t count, const char* what, const char* plural) {
  return fmt::format("{} {}", count, count == 1 ? what : plural);
}

}  // namespace

MeshStatus statusOf(const Mesh& mesh) {
  MeshStatus status;
  status.triangleCount = mesh.triangles.size();
  const std::vector<std::uint32_t> first = firstAtPosition(mesh.vertices);
  std::vector<glm::uvec3> triangles;
  triangles.reserve(mesh.triangles.size());
  for (const glm::uvec3& t : mesh.triangles) triangles.emplace_back(first[t.x], first[t.y], first[t.z]);
  countEdges(triangles, mesh.vertices.size(), status);
  status.duplicateTriangleCount = duplicateCount(triangles, mesh.vertices.size());
  for (const glm::uvec3& t : mesh.triangles) {
    status.degenerateTriangleCount += isDegenerate(mesh.vertices[t.x], mesh.vertices[t.y], mesh.vertices[t.z]);
  }
  status.unreferencedVertexCount = unreferencedCount(mesh);
  status.insideOut = status.closed && signedVolume(mesh) < 0;
  return status;
}

std::string MeshStatus::summary() const {
  std::string line;
  const auto add = [&](bool holds, const std::string& reason) {
    if (holds) line += (line.empty() ? "" : ", ") + reason;
  };
  const std::string boundary = counted(boundaryEdgeCount, "boundary edge", "boundary edges");
  add(triangleCount == 0, "no triangles");
  add(!closed, boundaryEdgeCount > 0 ? "not closed (" + boundary + ")" : "not closed");
  add(insideOut, "inside out");
  add(nonManifoldEdgeCount > 0, counted(nonManifoldEdgeCount, "non-manifold edge", "non-manifold edges"));
  add(inconsistentEdgeCount > 0,
      counted(inconsistentEdgeCount, "inconsistently oriented edge", "inconsistently oriented edges"));
  add(degenerateTriangleCount > 0, counted(degenerateTriangleCount, "degenerate triangle", "degenerate triangles"));
  add(duplicateTriangleCount > 0, counted(duplicateTriangleCount, "duplicate triangle", "duplicate triangles"));
  add(unreferencedVertexCount > 0, counted(unreferencedVertexCount, "unreferenced vertex", "unreferenced vertices"));
  return line;
}

}  // namespace copeel
