// Tile set-up: exact edge functions, depth functions scaled to keys.
#include "core/cpu/tile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include <glm/matrix.hpp>

#include "core/error.h"

namespace copeel::cpu {
namespace {

constexpr double kBias = 4503599627370496.0;              // 2^52: beyond it a double counts whole numbers
constexpr double kMostUncertainty = 1125899906842624.0;   // 2^50 key units: nothing is certain
// Two sums near 2^52 and a clamp round to whole key units.
constexpr double kKeyRounding = 3;
constexpr double kFinestError = 4;   // key units, of the most certain plane of a tile

struct Corners {
  glm::ivec2 p, q, r;
};

Corners cornersOf(const Frame& frame, std::uint32_t object, std::uint32_t reference) {
  if (reference >= kPrimitiveLimit) {
    const ClippedTriangle& piece = frame.bins.clipped[reference - kPrimitiveLimit];
    return {piece.corners[0], piece.corners[1], piece.corners[2]};
  }
  const glm::uvec3 t = frame.scene.objects()[object].mesh->triangles[reference - frame.scene.firstPrimitive(object)];
  const glm::ivec2* vertices = frame.projection.vertices.data() + frame.projection.firstVertex[object];
  return {vertices[t.x], vertices[t.y], vertices[t.z]};
}

bool mirrors(const glm::dmat4& m) { return glm::determinant(glm::dmat3(m)) < 0; }

// A triangle covers about half of its bounds.
double layersOf(const TriangleSetup& t, int pixels) { return 0.5 * (t.x1 - t.x0 + 1) * (t.y1 - t.y0 + 1) / pixels; }

}  // namespace

Frame::Frame(const Scene& scene_, const PlaneClasses& planes_, const View& view_)
    : scene(scene_), planes(planes_), view(view_), depths(depthPlanes(scene_, planes_, view_)),
      projection(project(scene_, view_)), bins(binTriangles(scene_, view_, projection)) {}

void Tile::begin(const Frame& frame, int index) {
  x0 = index % frame.bins.columns * kTileSize;
  y0 = index / frame.bins.columns * kTileSize;
  width = std::min(kTileSize, frame.view.width - x0);
  height = std::min(kTileSize, frame.view.height - y0);
  references_ = frame.bins.tile(index);
  objects.clear();
  slots.clear();
  setups.clear();
  nearest.clear();
  std::uint32_t end = 0;   // first primitive after the current object
  for (std::uint32_t i = 0; i < references_.size(); ++i) {
    const std::uint32_t reference = references_[i];
    const std::uint32_t primitive =
        reference < kPrimitiveLimit ? reference : frame.bins.clipped[reference - kPrimitiveLimit].primitive;
    if (primitive >= end) {
      const std::uint32_t object = frame.scene.objectOf(primitive);
      end = object + 1 < frame.scene.objects().size() ? frame.scene.firstPrimitive(object + 1) : kPrimitiveLimit;
      objects.push_back({object, i, i});
    }
    objects.back().lastReference = i + 1;
  }
}

void Tile::setUp(const Frame& frame) {
  ranges_.clear();
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    if (!objects[i].keep) continue;
    objects[i].range = {};
    const std::size_t first = slots.size();
    for (std::uint32_t k = objects[i].firstReference; k < objects[i].lastReference; ++k) {
      addTriangle(frame, objects[i], i, references_[k]);
    }
    if (slots.size() > first && mirrors(frame.scene.objects()[objects[i].object].worldFromObject)) {
      for (std::size_t s = first; s < slots.size(); ++s) slots[s].side = -slots[s].side;
    }
  }
}

void Tile::rangesOfBlocks(const Frame& frame, std::vector<DepthRange>& ranges) const {
  ranges.assign(kBlocksPerTile * objects.size(), {});
  constexpr int kLast = kBlockSize - 1;
  for (const TriangleSetup& t : setups) {
    const TileSlot& slot = slots[t.slot];
    if (!objects[slot.object].keep) continue;
    const double error = frame.depths[slot.planeClass].error;
    for (int by = t.y0 / kBlockSize; by <= t.y1 / kBlockSize; ++by) {
      for (int bx = t.x0 / kBlockSize; bx <= t.x1 / kBlockSize; ++bx) {
        const int x = bx * kBlockSize, y = by * kBlockSize;
        // An edge with the whole block on its outer side keeps the triangle out.
        bool outside = false;
        for (int i = 0; i < 3; ++i) {
          outside |= t.a[i] * (t.a[i] > 0 ? x + kLast : x) + t.b[i] * (t.b[i] > 0 ? y + kLast : y) + t.c[i] < 0;
        }
        if (outside) continue;
        const int left = std::max<int>(t.x0, x), right = std::min<int>(t.x1, x + kLast);
        const int top = std::max<int>(t.y0, y), bottom = std::min<int>(t.y1, y + kLast);
        const double small = t.dc + t.da * (t.da < 0 ? right : left) + t.db * (t.db < 0 ? bottom : top);
        const double large = t.dc + t.da * (t.da < 0 ? left : right) + t.db * (t.db < 0 ? top : bottom);
        ranges[(by * kBlocksPerSide + bx) * objects.size() + slot.object].add(std::clamp(small, t.lo, t.hi) - error,
                                                                             std::clamp(large, t.lo, t.hi) + error);
      }
    }
  }
}

void Tile::finish(const Frame& frame, double farthest, bool decideAllExactly) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    if (!objects[slots[i].object].keep || ranges_[i].least > farthest) continue;
    setups[kept] = setups[i];
    ranges_[kept++] = ranges_[i];
  }
  setups.resize(kept);
  ranges_.resize(kept);
  scaleDepths(frame, decideAllExactly);
}

void Tile::addTriangle(const Frame& frame, TileObject& object, std::uint32_t objectIndex, std::uint32_t reference) {
  auto [p, q, r] = cornersOf(frame, object.object, reference);
  const std::int64_t area = std::int64_t{q.x - p.x} * (r.y - p.y) - std::int64_t{q.y - p.y} * (r.x - p.x);
  if (area < 0) std::swap(q, r);
  const int bits = frame.projection.grid.bits;
  const int round = (1 << bits) - 1;
  const glm::ivec2 origin(x0 << bits, y0 << bits);

  // Samples that the bounds leave, within the tile.
  TriangleSetup t;
  const int left = std::max(((std::min({p.x, q.x, r.x}) + round) >> bits) - x0, 0);
  const int top = std::max(((std::min({p.y, q.y, r.y}) + round) >> bits) - y0, 0);
  const int right = std::min((std::max({p.x, q.x, r.x}) >> bits) - x0, width - 1);
  const int bottom = std::min((std::max({p.y, q.y, r.y}) >> bits) - y0, height - 1);
  if (left > right || top > bottom) return;
  t.x0 = left, t.y0 = top, t.x1 = right, t.y1 = bottom;

  // Edge functions at samples are whole numbers of 2^bits plus a constant: their floor has the same sign. An edge that holds the whole of the
  // bounds on its inner side is dropped.
  const glm::ivec2 corners[4] = {p, q, r, p};
  for (int i = 0; i < 3; ++i) {
    const glm::ivec2 from = corners[i], to = corners[i + 1];
    const std::int64_t a = from.y - to.y, b = to.x - from.x;
    const bool owns = a > 0 || (a == 0 && b > 0);   // the top-left rule: a sample on an edge belongs to one side only
    const std::int64_t c = (a * (origin.x - from.x) + b * (origin.y - from.y) - (owns ? 0 : 1)) >> bits;
    const std::int64_t largest = c + a * (a > 0 ? right : left) + b * (b > 0 ? bottom : top);
    const std::int64_t smallest = c + a * (a > 0 ? left : right) + b * (b > 0 ? top : bottom);
    if (largest < 0) return;
    const bool needed = smallest < 0;
    t.a[i] = needed ? static_cast<std::int32_t>(a) : 0;
    t.b[i] = needed ? static_cast<std::int32_t>(b) : 0;
    t.c[i] = needed ? static_cast<std::int32_t>(c) : 0;
  }

  const std::uint32_t primitive =
      reference < kPrimitiveLimit ? reference : frame.bins.clipped[reference - kPrimitiveLimit].primitive;
  const std::uint32_t local = primitive - frame.scene.firstPrimitive(object.object);
  const std::uint32_t planeClass =
      frame.planes.classOf(object.object, frame.scene.objects()[object.object].mesh->facetOf(local));
  const DepthPlane& plane = frame.depths[planeClass];
  const double u = x0 + 0.5 + frame.view.offset.x - frame.view.width * 0.5;
  const double v = y0 + 0.5 + frame.view.offset.y - frame.view.height * 0.5;
  t.slot = static_cast<std::uint32_t>(slots.size());
  t.da = plane.a;
  t.db = plane.b;
  t.dc = plane.a * u + (plane.b * v + plane.c);
  t.lo = plane.lo;
  t.hi = plane.hi;
  const double small = t.dc + std::min(t.da * left, t.da * right) + std::min(t.db * top, t.db * bottom);
  const double large = t.dc + std::max(t.da * left, t.da * right) + std::max(t.db * top, t.db * bottom);
  ranges_.push_back({std::clamp(small, t.lo, t.hi), std::clamp(large, t.lo, t.hi)});
  object.range.add(ranges_.back().least - plane.error, ranges_.back().most + plane.error);
  setups.push_back(t);
  slots.push_back({primitive, planeClass, objectIndex, area < 0 ? 1 : -1, 0});
}

void Tile::scaleDepths(const Frame& frame, bool decideAllExactly) {
  const int slotBits = std::max(static_cast<int>(std::bit_width(slots.size())), kKeyBits - kMostDepthBits);
  format.depthBits = kKeyBits - slotBits;
  // A margin of 2^-8 of the range at both ends takes the rounding.
  const double units = std::ldexp(1.0, format.depthBits), margin = units / 256;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (const DepthRange& range : ranges_) least = std::min(least, range.least), most = std::max(most, range.most);
  const double range = most - least;
  // A range so small that rounding would fill thousands of key units gains nothing from a larger scale.
  double leastError = std::numeric_limits<double>::infinity();
  for (const TileSlot& slot : slots) leastError = std::min(leastError, double(frame.depths[slot.planeClass].error));
  const double limit = std::clamp(kFinestError / leastError, 1e-200, 1e200);
  const double scale = std::min(range > 0 ? (units - 2 * margin) / range : 1.0, limit);
  const double shift = kBias + margin;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    TriangleSetup& t = setups[i];
    t.da *= scale;
    t.db *= scale;
    t.dc = (t.dc - least) * scale + shift;
    t.lo = std::max((t.lo - least) * scale, -margin) + shift;
    t.hi = std::min((t.hi - least) * scale, units - 2 * margin) + shift;
    TileSlot& slot = slots[t.slot];
    const double error = double(frame.depths[slot.planeClass].error) * scale * 1.25 + kKeyRounding;
    const double bound = decideAllExactly ? kMostUncertainty : std::min(std::ceil(error), kMostUncertainty);
    slot.uncertainty = static_cast<std::uint64_t>(bound);
  }
  // One bound for all but the coarse: then a gap between neighbours in sorted order parts everything before from everything after.
  uncertainty = 0;
  coarse = false;
  for (const TileSlot& slot : slots) {
    coarse |= slot.uncertainty > kCoarse;
    if (slot.uncertainty <= kCoarse) uncertainty = std::max(uncertainty, slot.uncertainty);
  }
  for (TileSlot& slot : slots) slot.uncertainty = std::max(slot.uncertainty, uncertainty);
}

double Tile::layers() const {
  double sum = 0;
  for (const TriangleSetup& t : setups) sum += layersOf(t, width * height);
  return sum;
}

std::size_t Tile::setupsOfLayers(double layers) const {
  std::size_t count = 0;
  while (count < setups.size() && layers > 0) layers -= layersOf(setups[count++], width * height);
  return count;
}

void Tile::orderByDepth() {
  struct Order {
    std::uint64_t depth;
    std::uint32_t setup;
  };
  std::vector<Order> order;
  order.reserve(setups.size());
  for (std::uint32_t i = 0; i < setups.size(); ++i) {
    const TriangleSetup& t = setups[i];
    const double least = t.dc + std::min(t.da * t.x0, t.da * t.x1) + std::min(t.db * t.y0, t.db * t.y1);
    const auto depth = static_cast<std::uint64_t>(std::clamp(least, t.lo, t.hi) - kBias);
    const std::uint64_t reach = slots[t.slot].uncertainty + 2;
    order.push_back({depth > reach ? depth - reach : 0, i});
  }
  std::sort(order.begin(), order.end(), [](const Order& a, const Order& b) {
    return a.depth != b.depth ? a.depth < b.depth : a.setup < b.setup;
  });
  std::vector<TriangleSetup> sorted;
  sorted.reserve(setups.size());
  nearest.clear();
  for (const Order& o : order) {
    sorted.push_back(setups[o.setup]);
    nearest.push_back(o.depth);
  }
  setups = std::move(sorted);
}

}  // namespace copeel::cpu
