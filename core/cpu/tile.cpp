// Tile set-up: corners are gathered into batches for edges.h, depth functions follow triangle by triangle and are scaled to keys.
#include "core/cpu/tile.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include <glm/matrix.hpp>

#include "core/error.h"

namespace copeel::cpu {
namespace {

constexpr double kBias = 4503599627370496.0;              // 2^52: beyond it a double counts whole numbers
constexpr std::uint64_t kMostUncertainty = std::uint64_t{1} << 50;   // key units: nothing is certain
// Two sums near 2^52 and a clamp round to whole key units.
constexpr double kKeyRounding = 3;
constexpr double kFinestError = 4;   // key units, of the most certain plane of a tile

// Of a value in [0, 2^63).
std::uint64_t roundedUp(double value) {
  const auto floor = static_cast<std::int64_t>(value);
  return static_cast<std::uint64_t>(floor) + (static_cast<double>(floor) < value);
}

bool mirrors(const glm::dmat4& m) { return glm::determinant(glm::dmat3(m)) < 0; }

std::uint32_t primitiveOf(const Frame& frame, std::uint32_t reference) {
  return reference < kPrimitiveLimit ? reference : frame.bins.clipped[reference - kPrimitiveLimit].primitive;
}

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
    const std::uint32_t primitive = primitiveOf(frame, reference);
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
  leastError_ = std::numeric_limits<double>::infinity();
  int count = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    TileObject& object = objects[i];
    if (!object.keep) continue;
    object.range = {};
    object.mirrored = mirrors(frame.scene.objects()[object.object].worldFromObject);
    // Batches run on from object to object.
    for (std::uint32_t k = object.firstReference; k < object.lastReference; ++k) {
      gather(frame, i, references_[k], count++);
      if (count == kEdgeBatch) setUpBatch(frame, std::exchange(count, 0));
    }
  }
  setUpBatch(frame, count);
}

// Corners to place `at` of the batch.
void Tile::gather(const Frame& frame, std::uint32_t objectIndex, std::uint32_t reference, int at) {
  const std::uint32_t object = objects[objectIndex].object;
  glm::ivec2 p, q, r;
  std::uint32_t triangle;
  if (reference < kPrimitiveLimit) {
    triangle = reference - frame.scene.firstPrimitive(object);
    const glm::uvec3 t = frame.scene.objects()[object].mesh->triangles[triangle];
    const glm::ivec2* vertices = frame.projection.vertices.data() + frame.projection.firstVertex[object];
    p = vertices[t.x], q = vertices[t.y], r = vertices[t.z];
  } else {
    const ClippedTriangle& piece = frame.bins.clipped[reference - kPrimitiveLimit];
    triangle = piece.primitive - frame.scene.firstPrimitive(object);
    p = piece.corners[0], q = piece.corners[1], r = piece.corners[2];
  }
  edges_.px[at] = p.x, edges_.py[at] = p.y, edges_.qx[at] = q.x, edges_.qy[at] = q.y, edges_.rx[at] = r.x, edges_.ry[at] = r.y;
  // The class's plane is wanted soon, and rarely lies near the last one.
  const std::uint32_t planeClass = frame.planes.classOf(object, frame.scene.objects()[object].mesh->facetOf(triangle));
  __builtin_prefetch(&frame.depths[planeClass]);
  gathered_[at] = {objectIndex, frame.scene.firstPrimitive(object) + triangle, planeClass};
}

void Tile::setUpBatch(const Frame& frame, int count) {
  setUpEdges(edges_, count, {x0, y0, width, height, frame.projection.grid.bits});
  // The tile's first sample, in the depth planes' coordinates.
  const double u = x0 + 0.5 + frame.view.offset.x - frame.view.width * 0.5;
  const double v = y0 + 0.5 + frame.view.offset.y - frame.view.height * 0.5;
  for (int i = 0; i < count; ++i) {
    if (edges_.side[i] == 0) continue;
    const Gathered& from = gathered_[i];
    TileObject& object = objects[from.object];
    addEdges(i);
    addDepth(frame.depths[from.planeClass], u, v, object);
    TileSlot& slot = slots.emplace_back();
    slot.primitive = from.primitive;
    slot.planeClass = from.planeClass;
    slot.object = from.object;
    slot.side = object.mirrored ? -edges_.side[i] : edges_.side[i];
  }
}

void Tile::addEdges(int at) {
  TriangleSetup& t = setups.emplace_back();
  for (int k = 0; k < 3; ++k) t.a[k] = edges_.a[k][at], t.b[k] = edges_.b[k][at], t.c[k] = edges_.c[k][at];
  t.x0 = edges_.x0[at], t.y0 = edges_.y0[at], t.x1 = edges_.x1[at], t.y1 = edges_.y1[at];
  t.samples = edges_.samples[at];
  t.slot = static_cast<std::uint32_t>(slots.size());
}

// The last setup's depth, in order values yet.
void Tile::addDepth(const DepthPlane& plane, double u, double v, TileObject& object) {
  TriangleSetup& t = setups.back();
  t.da = plane.a;
  t.db = plane.b;
  t.dc = plane.a * u + (plane.b * v + plane.c);
  t.lo = plane.lo;
  t.hi = plane.hi;
  const double small = t.dc + std::min(t.da * t.x0, t.da * t.x1) + std::min(t.db * t.y0, t.db * t.y1);
  const double large = t.dc + std::max(t.da * t.x0, t.da * t.x1) + std::max(t.db * t.y0, t.db * t.y1);
  const double error = plane.error;
  const SetupRange& range = ranges_.emplace_back(SetupRange{std::clamp(small, t.lo, t.hi), std::clamp(large, t.lo, t.hi), error});
  object.range.add(range.least - error, range.most + error);
  leastError_ = std::min(leastError_, error);
}

void Tile::rangesOfBlocks(std::vector<DepthRange>& ranges) const {
  ranges.assign(kBlocksPerTile * objects.size(), {});
  constexpr int kLast = kBlockSize - 1;
  for (std::size_t n = 0; n < setups.size(); ++n) {
    const TriangleSetup& t = setups[n];
    const std::uint32_t object = slots[t.slot].object;
    if (!objects[object].keep) continue;
    const double error = ranges_[n].error;
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
        ranges[(by * kBlocksPerSide + bx) * objects.size() + object].add(std::clamp(small, t.lo, t.hi) - error,
                                                                         std::clamp(large, t.lo, t.hi) + error);
      }
    }
  }
}

void Tile::finish(double farthest, bool decideAllExactly) {
  std::size_t kept = 0;
  double least = std::numeric_limits<double>::infinity(), most = -least;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const SetupRange& range = ranges_[i];
    if (!objects[slots[setups[i].slot].object].keep || range.least > farthest) continue;
    least = std::min(least, range.least), most = std::max(most, range.most);
    if (kept < i) setups[kept] = setups[i], ranges_[kept] = range;
    ++kept;
  }
  setups.resize(kept);
  ranges_.resize(kept);
  scaleDepths(least, most, decideAllExactly);
}

void Tile::scaleDepths(double least, double most, bool decideAllExactly) {
  const int slotBits = std::max(static_cast<int>(std::bit_width(slots.size())), kKeyBits - kMostDepthBits);
  format.depthBits = kKeyBits - slotBits;
  // A margin of 2^-8 of the range at both ends takes the rounding.
  const double units = std::ldexp(1.0, format.depthBits), margin = units / 256;
  const double range = most - least;
  // A range so small that rounding would fill thousands of key units gains nothing from a larger scale.
  const double limit = std::clamp(kFinestError / leastError_, 1e-200, 1e200);
  const double scale = std::min(range > 0 ? (units - 2 * margin) / range : 1.0, limit);
  const double shift = kBias + margin;
  // One bound for all but the coarse: then a gap between neighbours in sorted order parts everything before from everything after.
  uncertainty = 0;
  coarse = false;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    TriangleSetup& t = setups[i];
    t.da *= scale;
    t.db *= scale;
    t.dc = (t.dc - least) * scale + shift;
    t.lo = std::max((t.lo - least) * scale, -margin) + shift;
    t.hi = std::min((t.hi - least) * scale, units - 2 * margin) + shift;
    const double error = ranges_[i].error * scale * 1.25 + kKeyRounding;
    const std::uint64_t bound = decideAllExactly ? kMostUncertainty : roundedUp(std::min(error, double{kMostUncertainty}));
    slots[t.slot].uncertainty = bound;
    if (bound > kCoarse) coarse = true;
    else uncertainty = std::max(uncertainty, bound);
  }
  for (TileSlot& slot : slots) slot.uncertainty = std::max(slot.uncertainty, uncertainty);
}

double Tile::layers() const {
  std::int64_t samples = 0;
  for (const TriangleSetup& t : setups) samples += t.samples;
  return static_cast<double>(samples) / (width * height);
}

std::size_t Tile::setupsOfLayers(double layers) const {
  double samples = layers * width * height;
  std::size_t count = 0;
  while (count < setups.size() && samples > 0) samples -= setups[count++].samples;
  return count;
}

void Tile::flipSlots() {
  for (TriangleSetup& t : setups) t.slot = static_cast<std::uint32_t>(lastSlot()) - t.slot;
}

void Tile::orderByDepth() {
  // As in a key, the low bits hold an index: a setup's is never greater than a slot's.
  const int indexBits = format.slotBits();
  order_.clear();
  for (std::uint32_t i = 0; i < setups.size(); ++i) {
    const TriangleSetup& t = setups[i];
    const double least = t.dc + std::min(t.da * t.x0, t.da * t.x1) + std::min(t.db * t.y0, t.db * t.y1);
    const auto depth = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(least, t.lo, t.hi) - kBias));
    const std::uint64_t reach = slots[t.slot].uncertainty + 2;
    order_.push_back((depth > reach ? depth - reach : 0) << indexBits | i);
  }
  std::sort(order_.begin(), order_.end());
  sorted_.clear();
  nearest.clear();
  for (const std::uint64_t o : order_) {
    sorted_.push_back(setups[o & ((std::uint64_t{1} << indexBits) - 1)]);
    nearest.push_back(o >> indexBits);
  }
  setups.swap(sorted_);
}

}  // namespace copeel::cpu
