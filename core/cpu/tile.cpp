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

constexpr std::uint64_t kMostUncertainty = std::uint64_t{1} << 50;   // key units: nothing is certain
// A sum near 2^52 rounds to whole key units, by half of one; a difference and a product of up to 48 bits before it, by less than 2^-3.
constexpr double kKeyRounding = 1;
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
  makeRoom(withEdges_);
  makeRoom(edgeRoom_);
  keys.planes = frame.depths.data();
  keys.edges = edgeRoom_.data();
  const double u = x0 + 0.5 + frame.view.offset.x - frame.view.width * 0.5, v = y0 + 0.5 + frame.view.offset.y - frame.view.height * 0.5;
  for (std::size_t i = 0; i < std::size(keys.u); ++i) keys.u[i] = u + static_cast<double>(i);
  for (std::size_t i = 0; i < std::size(keys.v); ++i) keys.v[i] = v + static_cast<double>(i);
  count_ = smallCount_ = 0;
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
  std::copy_n(withEdges_.begin(), count_ - smallCount_, setupRoom_.begin() + static_cast<std::ptrdiff_t>(smallCount_));
  slots = {slotRoom_.data(), count_};
  setups = {setupRoom_.data(), count_};
  extent_ = edges_.extent;
}

// Corners to the places of the batch from `at` on. Most of what is read lies far away: each step reads what the one before has found for all of them,
// so that few reads wait for each other.
void Tile::gather(const Frame& frame, Source source, std::span<const std::uint32_t> references, int at) {
  const std::size_t count = references.size();
  glm::uvec3 corners[kEdgeBatch];
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t triangle = primitiveOf(frame, references[i]) - source.firstBinned;
    const std::uint32_t planeClass = source.classes[source.mesh->facetOf(triangle)];
    __builtin_prefetch(&frame.depths[planeClass]);
    edges_.primitive[at + i] = source.firstPrimitive + triangle, edges_.planeClass[at + i] = planeClass;
    edges_.object[at + i] = source.index, edges_.turn[at + i] = source.turn;
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
  setUpEdges(edges_, count, {x0, y0, width, height, frame.projection.grid.bits, keys.planes, keys.u[0], keys.v[0]});
  std::size_t at = count_, smallAt = smallCount_, withEdgesAt = at - smallAt;   // local ones stay in registers
  TileSlot* const slotsHere = slotRoom_.data();
  TriangleSetup* const setupsHere = setupRoom_.data();
  // What is not kept is overwritten by the next: no branch would foretell it.
  for (int i = 0; i < count; ++i) {
    slotsHere[at] = edges_.slots[i];
    setupsHere[smallAt] = edges_.setups[i];
    setupsHere[smallAt].slot = edges_.setups[i].slot = static_cast<std::uint32_t>(at);
    at += edges_.isKept[i];
    smallAt += edges_.isSmall[i];
  }
  for (std::uint32_t left = edges_.withEdges; left; left &= left - 1, ++withEdgesAt) {
    const int i = std::countr_zero(left);
    edgeRoom_[withEdgesAt] = edgesOfBatch(i);
    withEdges_[withEdgesAt] = edges_.setups[i];
    withEdges_[withEdgesAt].cover |= static_cast<std::uint32_t>(withEdgesAt);
  }
  count_ = at;
  smallCount_ = smallAt;
}

// Of the triangle at a place of the batch.
inline TriangleEdges Tile::edgesOfBatch(int i) const {
  TriangleEdges edges;
  for (int k = 0; k < 3; ++k) edges.a[k] = edges_.a[k][i], edges.b[k] = edges_.b[k][i], edges.c[k] = edges_.c[k][i];
  edges.samples = edges_.samples[i];
  return edges;
}

// orderAt at the corners of the bounds: no sample lies beyond.
DepthRange Tile::rangeOf(const TriangleSetup& t) const {
  const DepthPlane& plane = keys.planeOf(t);
  const double left = plane.a * keys.u[t.x0], right = plane.a * keys.u[t.x1], top = plane.b * keys.v[t.y0], bottom = plane.b * keys.v[t.y1];
  return {std::clamp<double>(std::min(left, right) + (std::min(top, bottom) + plane.c), plane.lo, plane.hi),
          std::clamp<double>(std::max(left, right) + (std::max(top, bottom) + plane.c), plane.lo, plane.hi)};
}

void Tile::findRanges() {
  for (TileObject& object : objects) object.range = {};
  for (const TriangleSetup& t : setups) {
    const DepthRange range = rangeOf(t);
    const double error = keys.planeOf(t).error();
    objects[slots[t.slot].object].range.add(range.least - error, range.most + error);
  }
}

void Tile::rangesOfBlocks(std::vector<DepthRange>& ranges) const {
  ranges.assign(kBlocksPerTile * objects.size(), {});
  constexpr int kLast = kBlockSize - 1;
  for (const TriangleSetup& t : setups) {
    const std::uint32_t object = slots[t.slot].object;
    if (!objects[object].keep) continue;
    const double error = keys.planeOf(t).error();
    for (int by = t.y0 / kBlockSize; by <= t.y1 / kBlockSize; ++by) {
      for (int bx = t.x0 / kBlockSize; bx <= t.x1 / kBlockSize; ++bx) {
        const int x = bx * kBlockSize, y = by * kBlockSize;
        // An edge with the whole block on its outer side keeps the triangle out.
        bool outside = false;
        for (int i = 0; i < 3 && t.hasEdges(); ++i) {
          const TriangleEdges& edges = keys.edgesOf(t);
          const std::int32_t a = edges.a[i], b = edges.b[i];
          outside |= a * (a > 0 ? x + kLast : x) + b * (b > 0 ? y + kLast : y) + edges.c[i] < 0;
        }
        if (outside) continue;
        TriangleSetup part = t;
        part.x0 = std::max<std::uint8_t>(t.x0, static_cast<std::uint8_t>(x)), part.x1 = std::min<std::uint8_t>(t.x1, static_cast<std::uint8_t>(x + kLast));
        part.y0 = std::max<std::uint8_t>(t.y0, static_cast<std::uint8_t>(y)), part.y1 = std::min<std::uint8_t>(t.y1, static_cast<std::uint8_t>(y + kLast));
        const DepthRange range = rangeOf(part);
        ranges[(by * kBlocksPerSide + bx) * objects.size() + object].add(range.least - error, range.most + error);
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
  for (const TriangleSetup& t : setups) {
    const DepthRange range = rangeOf(t);
    if (!objects[slots[t.slot].object].keep || range.least > farthest) continue;
    extent.add(range.least, range.most, keys.planeOf(t).error(), keys.samplesOf(t));
    setups[kept++] = t;
  }
  setups = setups.first(kept);
  extent_ = extent;
}

void Tile::scaleDepths(bool decideAllExactly) {
  KeyFormat& format = keys.format;
  const int slotBits = std::max(static_cast<int>(std::bit_width(slots.size())), kKeyBits - kMostDepthBits);
  format.depthBits = kKeyBits - slotBits;
  // A margin of 2^-8 of the range takes the rounding.
  const double units = std::ldexp(1.0, format.depthBits) * (1 - 1.0 / 256), range = extent_.most - extent_.least;
  // A range so small that rounding would fill thousands of key units gains nothing from a larger scale.
  const double limit = std::clamp(kFinestError / extent_.leastError, 1e-200, 1e200);
  keys.scale = std::min(range > 0 ? units / range : 1.0, limit);
  keys.least = extent_.least, keys.most = extent_.most;
  // One bound for all but the coarse: then a gap between neighbours in sorted order parts everything before from everything after.
  const auto inUnits = [this](double error) { return error * keys.scale * 1.25 + kKeyRounding; };
  coarse = decideAllExactly || inUnits(extent_.mostError) > double{kCoarse};
  coarseBounds.assign(coarse ? slots.size() : 0, 0);
  double common = coarse ? 0 : inUnits(extent_.mostError);
  for (std::size_t i = 0; coarse && i < setups.size(); ++i) {
    const double error = inUnits(keys.planeOf(setups[i]).error());
    if (error <= double{kCoarse} && !decideAllExactly) common = std::max(common, error);
    else coarseBounds[setups[i].slot] = decideAllExactly ? kMostUncertainty : roundedUp(std::min(error, double{kMostUncertainty}));
  }
  format.uncertainty = roundedUp(common);
}

std::size_t Tile::setupsOfLayers(double layers) const {
  double samples = layers * width * height;
  std::size_t count = 0;
  while (count < setups.size() && samples > 0) samples -= keys.samplesOf(setups[count++]);
  return count;
}

void Tile::orderByDepth() {
  // As in a key, the low bits hold an index: a setup's is never greater than a slot's.
  const int indexBits = keys.format.slotBits();
  order_.clear();
  for (std::uint32_t i = 0; i < setups.size(); ++i) {
    const TriangleSetup& t = setups[i];
    const auto depth = static_cast<std::uint64_t>((rangeOf(t).least - keys.least) * keys.scale);
    const std::uint64_t reach = std::max(coarse ? coarseBounds[t.slot] : 0, keys.format.uncertainty) + 2;
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

void Tile::orderBySlot() {
  std::sort(setups.begin(), setups.end(), [](const TriangleSetup& a, const TriangleSetup& b) { return a.slot < b.slot; });
}

}  // namespace copeel::cpu
