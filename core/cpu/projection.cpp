// Projection in double, snapped once; clipping by Sutherland and Hodgman in camera coordinates, each cut made from the lexicographically
// smaller end of the edge so that both triangles of the edge make the same one.
#include "core/cpu/projection.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <tuple>

#include <glm/geometric.hpp>

#include "core/coplanarity/depth_planes.h"
#include "core/cpu/place_vertices.h"
#include "core/parallel.h"

namespace copeel::cpu {
namespace {

constexpr int kCoordinateBits = 24;   // extent of the grid: differences below 2^24 keep edge functions of a tile within 31 bits
constexpr int kMostBits = 12;
constexpr double kMarginPx = 64;
constexpr std::size_t kGrain = 4096;   // vertices, for parallel loops

// Camera coordinates: (x, y) pixels from the view axis at unit distance (perspective) or anywhere, z along the axis.
struct Camera {
  explicit Camera(const View& v)
      : view(v), right(v.right / glm::dot(v.right, v.right)), down(v.down / glm::dot(v.down, v.down)) {}

  glm::dvec3 operator()(const glm::dvec3& world) const {
    const glm::dvec3 p = world - view.eye;
    return {glm::dot(right, p), glm::dot(down, p), glm::dot(view.forward, p)};
  }
  double weight(const glm::dvec3& c) const { return view.perspective ? c.z : 1.0; }

  const View& view;
  glm::dvec3 right, down;
};

struct Frame {
  double originX, originY;   // of sample (0, 0), in pixels from the view axis
  double limitX, limitY;     // largest |x|, |y| from the view axis that fits the grid, pixels
  double scale;
};

Frame frameOf(const View& view, const Grid& grid) {
  return {0.5 + view.offset.x - view.width * 0.5, 0.5 + view.offset.y - view.height * 0.5, view.width * 0.5 + grid.guardPx,
          view.height * 0.5 + grid.guardPx, std::ldexp(1.0, grid.bits)};
}

glm::ivec2 snap(double u, double v, const Frame& frame) {
  return {static_cast<int>(std::lrint((u - frame.originX) * frame.scale)), static_cast<int>(std::lrint((v - frame.originY) * frame.scale))};
}

// Signed distance to a clip plane: 0 the near plane, 1 … 4 the guard band. Not negative is inside.
double clipDistance(const Camera& camera, const Frame& frame, double nearest, const glm::dvec3& p, int plane) {
  const double w = camera.weight(p);
  switch (plane) {
    case 0: return camera.view.perspective ? p.z - nearest : 1.0;
    case 1: return frame.limitX * w + p.x;
    case 2: return frame.limitX * w - p.x;
    case 3: return frame.limitY * w + p.y;
    default: return frame.limitY * w - p.y;
  }
}

bool lexicographicallyLess(const glm::dvec3& a, const glm::dvec3& b) { return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z); }

glm::dvec3 cutEdge(glm::dvec3 a, double da, glm::dvec3 b, double db) {
  if (lexicographicallyLess(b, a)) std::swap(a, b), std::swap(da, db);
  return a + (b - a) * (da / (da - db));
}

}  // namespace

Grid gridFor(const View& view) {
  const double size = std::max(view.width, view.height);
  Grid grid;
  grid.guardPx = size * 0.5 + kMarginPx;
  const double span = size + 2 * grid.guardPx;
  grid.bits = std::min(kMostBits, kCoordinateBits - static_cast<int>(std::ceil(std::log2(span))));
  return grid;
}

Projection project(const Scene& scene, const View& view) {
  Projection result;
  result.grid = gridFor(view);
  const std::size_t objectCount = scene.objects().size();
  result.reachesEye.assign(objectCount, 0);
  std::vector<std::uint8_t> shares(objectCount);
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < objectCount; ++i) {
    shares[i] = scene.repeats(i);
    result.firstVertex.push_back(shares[i] ? result.firstVertex.back() : count);
    if (!shares[i]) count += scene.objects()[i].mesh->vertices.size();
  }
  result.vertices = UninitializedVector<glm::ivec2>(count);

  const Camera camera(view);
  const Frame frame = frameOf(view, result.grid);
  const double nearest = nearDistance(scene, view);
  parallelFor(objectCount, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      if (shares[i]) continue;
      const Object& object = scene.objects()[i];
      glm::ivec2* const out = result.vertices.data() + result.firstVertex[i];
      const std::size_t vertexCount = object.mesh->vertices.size();
      const Placement placement{object.worldFromObject, view.eye, camera.right, camera.down, view.forward, view.perspective, nearest,
                                frame.limitX, frame.limitY, frame.originX, frame.originY, frame.scale};
      const auto projectRange = [&](std::size_t first, std::size_t last) {
        if (!placeVertices(placement, {object.mesh->vertices.data() + first, last - first}, out + first)) return;
        std::atomic_ref<std::uint8_t>(result.reachesEye[i]).store(1, std::memory_order_relaxed);
      };
      if (vertexCount <= kGrain) projectRange(0, vertexCount);
      else parallelFor(vertexCount, kGrain, projectRange);
    }
  });
  for (std::size_t i = 1; i < objectCount; ++i) {
    if (shares[i]) result.reachesEye[i] = result.reachesEye[i - 1];
  }
  return result;
}

void clipTriangle(const Scene& scene, const View& view, const Grid& grid, std::uint32_t object, std::uint32_t primitive,
                  std::vector<ClippedTriangle>& pieces) {
  const Camera camera(view);
  const Frame frame = frameOf(view, grid);
  const double nearest = nearDistance(scene, view);
  std::array<glm::dvec3, 8> polygon, next;   // a triangle cut by five planes has eight corners at most
  int corners = 3;
  const glm::uvec3 t = scene.objects()[object].mesh->triangles[primitive - scene.firstPrimitive(object)];
  for (int k = 0; k < 3; ++k) polygon[k] = camera(scene.worldVertex(object, t[k]));

  for (int plane = 0; plane < 5 && corners > 0; ++plane) {
    int kept = 0;
    for (int i = 0; i < corners; ++i) {
      const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % corners];
      const double da = clipDistance(camera, frame, nearest, a, plane), db = clipDistance(camera, frame, nearest, b, plane);
      if (da >= 0) next[kept++] = a;
      if ((da >= 0) != (db >= 0)) next[kept++] = cutEdge(a, da, b, db);
    }
    std::copy_n(next.begin(), kept, polygon.begin());
    corners = kept;
  }

  std::array<glm::ivec2, 8> snapped;
  for (int i = 0; i < corners; ++i) {
    const double w = std::max(camera.weight(polygon[i]), view.perspective ? nearest : 1.0);
    snapped[i] = snap(std::clamp(polygon[i].x / w, -frame.limitX, frame.limitX),
                      std::clamp(polygon[i].y / w, -frame.limitY, frame.limitY), frame);
  }
  for (int i = 2; i < corners; ++i) pieces.push_back({{snapped[0], snapped[i - 1], snapped[i]}, primitive});
}

}  // namespace copeel::cpu
