// Tile set-up: corners and planes are gathered into batches for edges.h; depths are scaled to keys once all are known.
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
    : scene(scene_), planes(planes_), view(view_), projection(project(scene_, view_)),
      bins(binTriangles(scene_, view_, projection)), depths(depthPlanes(scene_, planes_, view_)) {}

void Tile::begin(const Frame& frame, int index) {
  x0 = index % frame.bins.columns * kTileSize;
  y0 = index / frame.bins.columns * kTileSize;
  width = std::min(kTileSize, frame.view.width - x0);
  height = std::min(kTileSize, frame.view.height - y0);
  references_ = frame.bins.tile(index);
  objects.clear();
  slots = {};
  setups = {};
  nearest.clear();
  const auto objectCount = static_cast<std::uint32_t>(frame.scene.objects().size());
  for (std::size_t i = 0; i < references_.size(); i = objects.back().lastReference) {
    const std::uint32_t object = frame.scene.objectOf(primitiveOf(frame, references_[i]));
    const std::uint32_t end = object + 1 == objectCount ? kPrimitiveLimit : frame.scene.firstPrimitive(object + 1);
    const auto isOfObject = [&](std::uint32_t reference) { return primitiveOf(frame, reference) < end; };
    std::size_t step = 1;
    while (step < references_.size() - i && isOfObject(references_[i + step])) step *= 2;
    const auto some = references_.subspan(i + step / 2, std::min(step, references_.size() - i) - step / 2);
    const auto past = static_cast<std::size_t>(std::partition_point(some.begin(), some.end(), isOfObject) - references_.begin());
    for (std::uint32_t same = object; same < objectCount && frame.scene.originalOf(same) == object; ++same) {
      objects.push_back({same, static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(past)});
    }
  }
}

Tile::Source Tile::sourceOf(const Frame& frame, std::uint32_t index) const {
  const std::uint32_t object = objects[index].object;
  const Object& placed = frame.scene.objects()[object];
  return {.index = index,
          .turn = mirrors(placed.worldFromObject) ? -1 : 1,
          .firstPrimitive = frame.scene.firstPrimitive(object),
          .firstBinned = frame.scene.firstPrimitive(frame.scene.originalOf(object)),
          .mesh = placed.mesh.get(),
          .vertices = frame.projection.vertices.data() + frame.projection.firstVertex[object],
          .classes = frame.planes.classesOfObject(object)};
}

void Tile::setUp(const Frame& frame) {
  std::size_t most = 0;
  for (const TileObject& object : objects) most += object.lastReference - object.firstReference;
  const auto makeRoom = [&](auto& room) {
    if (room.size() < most) room.resize(most);
  };
  makeRoom(slotRoom_);
  makeRoom(setupRoom_);
  makeRoom(edgeRoom_);
  makeRoom(ranges_);
  count_ = edgeCount_ = 0;
  edges_.extent = {};
  int count = 0;
  for (std::uint32_t i = 0; i < objects.size(); ++i) {
    TileObject& object = objects[i];
    if (!object.keep) continue;
    const Source source = sourceOf(frame, i);
    // Batches run on from object to object.
    for (std::uint32_t k = object.firstReference; k < object.lastReference;) {
      const auto references = references_.subspan(k, std::min<std::size_t>(object.lastReference - k, kEdgeBatch - count));
      gather(frame, source, references, count);
      k += references.size();
      count += static_cast<int>(references.size());
      if (count == kEdgeBatch) setUpBatch(frame, std::exchange(count, 0));
    }
  }
  setUpBatch(frame, count);
  slots = {slotRoom_.data(), count_};
  setups = {setupRoom_.data(), count_};
  extent_ = edges_.extent;
}

// Corners to the places of the batch from `at` on. Most of what is read lies far away: each step reads what the one before has found for all of them,
// so that few reads wait for each other.
void Tile::gather(const Frame& frame, const Source& source, std::span<const std::uint32_t> references, int at) {
  const std::size_t count = references.size();
  glm::uvec3 corners[kEdgeBatch];
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t triangle = primitiveOf(frame, references[i]) - source.firstBinned;
    const std::uint32_t planeClass = source.classes[source.mesh->facetOf(triangle)];
    __builtin_prefetch(&frame.depths[planeClass]);
    __builtin_prefetch(&frame.depths[planeClass].error);
    gathered_[at + i] = {source.firstPrimitive + triangle, planeClass, source.index, source.turn, 0};
    corners[i] = source.mesh->triangles[triangle];
  }
  for (std::size_t i = 0; i < count; ++i) {
    glm::ivec2 &p = edges_.p[at + i], &q = edges_.q[at + i], &r = edges_.r[at + i];
    if (references[i] < kPrimitiveLimit) {
      p = source.vertices[corners[i].x], q = source.vertices[corners[i].y], r = source.vertices[corners[i].z];
    } else {
      const ClippedTriangle& piece = frame.bins.clipped[references[i] - kPrimitiveLimit];
      p = piece.corners[0], q = piece.corners[1], r = piece.corners[2];
    }
  }
}

void Tile::setUpBatch(const Frame& frame, int count) {
  for (int i = 0; i < count; ++i) {
    const DepthPlane& plane = frame.depths[gathered_[i].planeClass];
    edges_.planeA[i] = plane.a, edges_.planeB[i] = plane.b, edges_.planeC[i] = plane.c;
    edges_.planeLo[i] = plane.lo, edges_.planeHi[i] = plane.hi, edges_.planeError[i] = plane.error;
  }
  // The tile's first sample, in the depth planes' coordinates.
  const double u = x0 + 0.5 + frame.view.offset.x - frame.view.width * 0.5;
  const double v = y0 + 0.5 + frame.view.offset.y - frame.view.height * 0.5;
  setUpEdges(edges_, count, {x0, y0, width, height, frame.projection.grid.bits, u, v});
  std::size_t at = count_, edgesAt = edgeCount_;   // local ones stay in registers
  TileSlot* const slotsHere = slotRoom_.data();
  TriangleSetup* const setupsHere = setupRoom_.data();
  TriangleEdges* const edgesHere = edgeRoom_.data();
  SetupRange* const rangesHere = ranges_.data();
  for (int i = 0; i < count; ++i) {
    if (edges_.side[i] == 0) continue;
    slotsHere[at] = gathered_[i];
    slotsHere[at].side *= edges_.side[i];
    rangesHere[at] = {edges_.least[i], edges_.most[i], edges_.error[i]};
    putSetup(i, static_cast<std::uint32_t>(at), setupsHere[at]);
    if (!edges_.covered[i]) putEdges(i, edgesHere[edgesAt]), setupsHere[at].edges = &edgesHere[edgesAt++];
    ++at;
  }
  count_ = at;
  edgeCount_ = edgesAt;
}

// Of the triangle at a place of the batch. Its depth in order values yet.
inline void Tile::putSetup(int i, std::uint32_t slot, TriangleSetup& t) const {
  const auto bounds = static_cast<std::uint32_t>(edges_.bounds[i]);
  t.x0 = static_cast<std::uint8_t>(bounds), t.y0 = static_cast<std::uint8_t>(bounds >> 8);
  t.x1 = static_cast<std::uint8_t>(bounds >> 16), t.y1 = static_cast<std::uint8_t>(bounds >> 24);
  t.slot = slot;
  t.covered = static_cast<std::uint32_t>(edges_.covered[i]);
  t.samples = static_cast<std::uint16_t>(edges_.samples[i]);
  t.edges = nullptr;
  t.da = edges_.planeA[i], t.db = edges_.planeB[i], t.dc = edges_.dc[i], t.lo = edges_.lo[i], t.hi = edges_.hi[i];
}

inline void Tile::putEdges(int i, TriangleEdges& edges) const {
  for (int k = 0; k < 3; ++k) edges.a[k] = edges_.a[k][i], edges.b[k] = edges_.b[k][i], edges.c[k] = edges_.c[k][i];
}

void Tile::findRanges() {
  for (TileObject& object : objects) object.range = {};
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const SetupRange& range = ranges_[i];
    objects[slots[setups[i].slot].object].range.add(range.least - range.error, range.most + range.error);
  }
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
        for (int i = 0; i < 3 && t.edges; ++i) {
          const std::int32_t a = t.edges->a[i], b = t.edges->b[i];
          outside |= a * (a > 0 ? x + kLast : x) + b * (b > 0 ? y + kLast : y) + t.edges->c[i] < 0;
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
  const bool keepsAll = std::all_of(objects.begin(), objects.end(), [](const TileObject& object) { return object.keep; });
  if (!keepsAll || farthest < std::numeric_limits<double>::infinity()) drop(farthest);
  scaleDepths(decideAllExactly);
}

void Tile::drop(double farthest) {
  std::size_t kept = 0;
  DepthExtent extent;
  for (std::size_t i = 0; i < setups.size(); ++i) {
    const SetupRange& range = ranges_[i];
    if (!objects[slots[setups[i].slot].object].keep || range.least > farthest) continue;
    extent.add(range.least, range.most, range.error, setups[i].samples);
    if (kept < i) setups[kept] = setups[i], ranges_[kept] = range;
    ++kept;
  }
  setups = setups.first(kept);
  extent_ = extent;
}

void Tile::scaleDepths(bool decideAllExactly) {
  const int slotBits = std::max(static_cast<int>(std::bit_width(slots.size())), kKeyBits - kMostDepthBits);
  format.depthBits = kKeyBits - slotBits;
  // A margin of 2^-8 of the range at both ends takes the rounding.
  const double units = std::ldexp(1.0, format.depthBits), margin = units / 256;
  const double range = extent_.most - extent_.least, least = extent_.least;
  // A range so small that rounding would fill thousands of key units gains nothing from a larger scale.
  const double limit = std::clamp(kFinestError / extent_.leastError, 1e-200, 1e200);
  const double scale = std::min(range > 0 ? (units - 2 * margin) / range : 1.0, limit);
  cpu::scaleDepths(setups, {least, scale, margin, units - 2 * margin, kBias + margin});
  // One bound for all but the coarse: then a gap between neighbours in sorted order parts everything before from everything after.
  const auto inUnits = [scale](double error) { return error * scale * 1.25 + kKeyRounding; };
  coarse = decideAllExactly || inUnits(extent_.mostError) > double{kCoarse};
  double common = coarse ? 0 : inUnits(extent_.mostError);
  for (std::size_t i = 0; coarse && i < setups.size(); ++i) {
    const double error = inUnits(ranges_[i].error);
    if (error <= double{kCoarse} && !decideAllExactly) common = std::max(common, error);
    else slots[setups[i].slot].coarseBound = decideAllExactly ? kMostUncertainty : roundedUp(std::min(error, double{kMostUncertainty}));
  }
  format.uncertainty = roundedUp(common);
}

std::size_t Tile::setupsOfLayers(double layers) const {
  double samples = layers * width * height;
  std::size_t count = 0;
  while (count < setups.size() && samples > 0) samples -= setups[count++].samples;
  return count;
}

void Tile::orderByDepth() {
  // As in a key, the low bits hold an index: a setup's is never greater than a slot's.
  const int indexBits = format.slotBits();
  order_.clear();
  for (std::uint32_t i = 0; i < setups.size(); ++i) {
    const TriangleSetup& t = setups[i];
    const double least = t.dc + std::min(t.da * t.x0, t.da * t.x1) + std::min(t.db * t.y0, t.db * t.y1);
    const auto depth = static_cast<std::uint64_t>(static_cast<std::int64_t>(std::clamp(least, t.lo, t.hi) - kBias));
    const std::uint64_t reach = std::max(slots[t.slot].coarseBound, format.uncertainty) + 2;
    order_.push_back((depth > reach ? depth - reach : 0) << indexBits | i);
  }
  std::sort(order_.begin(), order_.end());
  sortedRoom_.clear();
  nearest.clear();
  for (const std::uint64_t o : order_) {
    sortedRoom_.push_back(setups[o & ((std::uint64_t{1} << indexBits) - 1)]);
    nearest.push_back(o >> indexBits);
  }
  setups = sortedRoom_;
}

}  // namespace copeel::cpu
