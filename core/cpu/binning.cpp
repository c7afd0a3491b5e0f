// Chunks of triangles are binned in parallel to lists of (tile, reference), then gathered by a counting sort that keeps their order:
// the result does not depend on the number of threads.
#include "core/cpu/binning.h"

#include <algorithm>
#include <utility>

#include "core/cpu/single_tile.h"
#include "core/parallel.h"

namespace copeel::cpu {
namespace {

constexpr std::uint32_t kChunkTriangles = 4096;   // of twice as many, meshes of 70,000 triangles leave one of two threads waiting (measured)

struct Chunk {
  std::uint32_t firstObject, firstTriangle;   // where it starts
  std::uint32_t count;                        // triangles, running on into the next objects that are binned
};

struct Entry {
  std::uint32_t tile, reference;
};

struct ChunkBins {
  std::vector<Entry> entries;
  std::vector<ClippedTriangle> clipped;
};

// Of the objects that do not repeat the one before.
std::vector<Chunk> chunksOf(const Scene& scene) {
  std::vector<Chunk> chunks;
  for (std::uint32_t object = 0; object < scene.objects().size(); ++object) {
    if (scene.repeats(object)) continue;
    const auto triangles = static_cast<std::uint32_t>(scene.objects()[object].mesh->triangles.size());
    for (std::uint32_t first = 0; first < triangles;) {
      if (chunks.empty() || chunks.back().count == kChunkTriangles) chunks.push_back({object, first, 0});
      const std::uint32_t some = std::min(kChunkTriangles - chunks.back().count, triangles - first);
      chunks.back().count += some, first += some;
    }
  }
  return chunks;
}

// The tiles a triangle may cover a sample of.
class Binner {
 public:
  Binner(const View& view, int bits, int columns, std::vector<Entry>& entries)
      : bits_(bits), width_(view.width), height_(view.height), columns_(columns), entries_(entries) {}

  void add(const glm::ivec2& p, const glm::ivec2& q, const glm::ivec2& r, std::uint32_t reference) {
    // Samples have whole-pixel coordinates: the first at or after the smallest corner, the last at or before the largest.
    const int round = (1 << bits_) - 1;
    const int x0 = std::max((std::min(std::min(p.x, q.x), r.x) + round) >> bits_, 0);
    const int y0 = std::max((std::min(std::min(p.y, q.y), r.y) + round) >> bits_, 0);
    const int x1 = std::min(std::max(std::max(p.x, q.x), r.x) >> bits_, width_ - 1);
    const int y1 = std::min(std::max(std::max(p.y, q.y), r.y) >> bits_, height_ - 1);
    if (x0 > x1 || y0 > y1) return;
    const int c0 = tileAt(x0), c1 = tileAt(x1), r0 = tileAt(y0), r1 = tileAt(y1);
    if (c0 == c1 && r0 == r1) put(c0, r0, reference);
    else addToMany(p, q, r, {c0, r0, c1, r1}, reference);
  }

 private:
  struct Tiles {
    int c0, r0, c1, r1;   // columns and rows, inclusive
  };
  static int tileAt(int pixel) { return static_cast<int>(static_cast<unsigned>(pixel) / kTileSize); }

  void put(int column, int row, std::uint32_t reference) { entries_.push_back({static_cast<std::uint32_t>(row * columns_ + column), reference}); }

  __attribute__((noinline)) void addToMany(const glm::ivec2& p, const glm::ivec2& q, const glm::ivec2& r, const Tiles& tiles, std::uint32_t reference) {
    // Two tiles of which a triangle misses one are told as fast by its set-up.
    if (tiles.c1 - tiles.c0 + tiles.r1 - tiles.r0 == 1) {
      put(tiles.c0, tiles.r0, reference);
      put(tiles.c1, tiles.r1, reference);
      return;
    }
    const std::int64_t area = std::int64_t{q.x - p.x} * (r.y - p.y) - std::int64_t{q.y - p.y} * (r.x - p.x);
    if (area == 0) return;
    for (int row = tiles.r0; row <= tiles.r1; ++row) {
      for (int column = tiles.c0; column <= tiles.c1; ++column) {
        if (!misses(p, q, r, area > 0, column, row)) put(column, row, reference);
      }
    }
  }

  // True when one edge has the whole tile on its outer side.
  bool misses(const glm::ivec2& p, const glm::ivec2& q, const glm::ivec2& r, bool positive, int column, int row) const {
    return outside(p, q, positive, column, row) || outside(q, r, positive, column, row) || outside(r, p, positive, column, row);
  }
  bool outside(const glm::ivec2& from, const glm::ivec2& to, bool positive, int column, int row) const {
    std::int64_t a = from.y - to.y, b = to.x - from.x;
    if (!positive) a = -a, b = -b;
    const std::int64_t x = std::int64_t{column * kTileSize + (a > 0 ? kTileSize - 1 : 0)} << bits_;
    const std::int64_t y = std::int64_t{row * kTileSize + (b > 0 ? kTileSize - 1 : 0)} << bits_;
    return a * (x - from.x) + b * (y - from.y) < 0;
  }

  int bits_, width_, height_, columns_;
  std::vector<Entry>& entries_;
};

void binChunk(const Scene& scene, const View& view, const Projection& projection, const Chunk& chunk, int columns, ChunkBins& out) {
  Binner binner(view, projection.grid.bits, columns, out.entries);
  std::uint32_t object = chunk.firstObject, triangle = chunk.firstTriangle, left = chunk.count;
  const TileGrid grid{projection.grid.bits, view.width, view.height, columns};
  CornerBatch batch;
  std::vector<ClippedTriangle> pieces;
  const auto binOne = [&](std::uint32_t primitive, const glm::ivec2& p, const glm::ivec2& q, const glm::ivec2& r) {
    if (p.x != kOffGrid && q.x != kOffGrid && r.x != kOffGrid) return binner.add(p, q, r, primitive);
    pieces.clear();
    clipTriangle(scene, view, projection.grid, object, primitive, pieces);
    for (const ClippedTriangle& piece : pieces) {
      // The reference is relative to the chunk until the chunks are joined.
      binner.add(piece.corners[0], piece.corners[1], piece.corners[2], kPrimitiveLimit + static_cast<std::uint32_t>(out.clipped.size()));
      out.clipped.push_back(piece);
    }
  };
  for (; left > 0; ++object, triangle = 0) {
    if (scene.repeats(object)) continue;
    const Mesh& mesh = *scene.objects()[object].mesh;
    const glm::ivec2* vertices = projection.vertices.data() + projection.firstVertex[object];
    const auto end = static_cast<std::uint32_t>(std::min<std::size_t>(mesh.triangles.size(), std::size_t{triangle} + left));
    left -= end - triangle;
    for (; triangle < end; triangle += CornerBatch::kSize) {
      const std::size_t count = std::min<std::size_t>(CornerBatch::kSize, end - triangle);
      const glm::uvec3* const triangles = mesh.triangles.data() + triangle;
      for (std::size_t i = 0; i < count; ++i) {
        batch.p[i] = vertices[triangles[i].x], batch.q[i] = vertices[triangles[i].y], batch.r[i] = vertices[triangles[i].z];
      }
      findSingleTiles(batch, count, grid);
      const std::uint32_t first = scene.firstPrimitive(object) + triangle;
      for (std::uint32_t i = 0; i < count; ++i) {
        if (batch.tile[i] >= 0) out.entries.push_back({static_cast<std::uint32_t>(batch.tile[i]), first + i});
        else if (batch.tile[i] == kManyTiles) binOne(first + i, batch.p[i], batch.q[i], batch.r[i]);
      }
    }
  }
}

}  // namespace

Bins binTriangles(const Scene& scene, const View& view, const Projection& projection) {
  Bins bins;
  bins.columns = (view.width + kTileSize - 1) / kTileSize;
  bins.rows = (view.height + kTileSize - 1) / kTileSize;
  const std::vector<Chunk> chunks = chunksOf(scene);
  std::vector<ChunkBins> parts(chunks.size());
  parallelFor(chunks.size(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      parts[i].entries.reserve(chunks[i].count + chunks[i].count / 4);   // some lie in several tiles
      binChunk(scene, view, projection, chunks[i], bins.columns, parts[i]);
    }
  });

  // Join the clipped pieces, and let the references follow.
  for (ChunkBins& part : parts) {
    const auto base = static_cast<std::uint32_t>(bins.clipped.size());
    if (base > 0 && !part.clipped.empty()) {
      for (Entry& e : part.entries) e.reference += e.reference >= kPrimitiveLimit ? base : 0;
    }
    bins.clipped.insert(bins.clipped.end(), part.clipped.begin(), part.clipped.end());
  }

  // Counting sort by tile: groups of consecutive chunks count for themselves, a prefix sum over (tile, group) gives each its places.
  const std::size_t tiles = static_cast<std::size_t>(bins.columns) * bins.rows;
  const std::size_t groups = std::clamp<std::size_t>(threadLimit(), 1, std::max<std::size_t>(parts.size(), 1));
  std::vector<std::vector<std::uint64_t>> place(groups, std::vector<std::uint64_t>(tiles, 0));
  const auto forGroups = [&](auto&& visit) {
    parallelFor(groups, 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t g = begin; g != end; ++g) {
        for (std::size_t i = parts.size() * g / groups; i < parts.size() * (g + 1) / groups; ++i) visit(parts[i], place[g]);
      }
    });
  };
  forGroups([](const ChunkBins& part, std::vector<std::uint64_t>& counts) {
    for (const Entry& e : part.entries) ++counts[e.tile];
  });
  bins.first.resize(tiles + 1);
  std::uint64_t sum = 0;
  for (std::size_t tile = 0; tile < tiles; ++tile) {
    bins.first[tile] = sum;
    for (auto& p : place) sum += std::exchange(p[tile], sum);
  }
  bins.first[tiles] = sum;
  bins.references = UninitializedVector<std::uint32_t>(sum);
  forGroups([&](ChunkBins& part, std::vector<std::uint64_t>& places) {
    for (const Entry& e : part.entries) bins.references[places[e.tile]++] = e.reference;
    part.entries = {};
  });
  return bins;
}

}  // namespace copeel::cpu
