// A tile: the triangles that touch it, set up for the kernels. Its depth keys span just the depths that occur in it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/cpu/edges.h"
#include "core/cpu/frame.h"
#include "core/cpu/kernels.h"

namespace copeel::cpu {

// Order values (depth_planes.h) that triangles reach, their error bounds included; as made, of none.
struct DepthRange {
  double least = std::numeric_limits<double>::infinity(), most = -std::numeric_limits<double>::infinity();
  void add(double from, double to) { least = std::min(least, from), most = std::max(most, to); }
  bool empty() const { return least > most; }
};

struct TileObject {
  std::uint32_t object;                     // of the scene
  std::uint32_t firstReference, lastReference;   // of the object that was binned (binning.h)
  bool keep = true;                         // cleared by a fold that has no use for the object in this tile
  DepthRange range{};                       // after findRanges: in the tile
};

inline constexpr std::uint64_t kCoarse = 4096;   // key units; up to it, all slots of a tile carry one common bound (KeyFormat)

class Tile {
 public:
  Tile() = default;
  Tile(const Tile&) = delete;   // it holds spans of its own

  // Finds the objects that touch a tile. O(objects · log references).
  void begin(const Frame& frame, int index);
  // Sets the triangles of the kept objects up.
  void setUp(const Frame& frame);
  // The depths of each object, for folds that ask. After setUp.
  void findRanges();
  // The same in each block, [block][object]; blocks that a triangle just passes by may count as touched. After setUp, before finish.
  void rangesOfBlocks(std::vector<DepthRange>& ranges) const;
  // Drops the triangles of objects that are no longer kept and those wholly beyond `farthest`; scales depths to keys.
  void finish(double farthest, bool decideAllExactly);
  // Orders the setups by nearest depth, so that they can be met front to back; or by slot. After finish.
  void orderByDepth();
  void orderBySlot();

  int x0 = 0, y0 = 0;                       // of its first pixel
  int width = 0, height = 0;                // inside the image
  std::vector<TileObject> objects;          // ascending
  std::span<TileSlot> slots;                // ascending by primitive
  std::span<TriangleSetup> setups;
  std::vector<std::uint64_t> nearest;       // after orderByDepth: lower bound of the depth of each setup and all after it
  double layers() const { return static_cast<double>(extent_.samples) / (width * height); }   // about how many fragments a pixel has
  std::size_t setupsOfLayers(double layers) const;   // how many setups, from the first, make about so many
  TileKeys keys;
  bool coarse = false;                      // some slot is so uncertain that its neighbours in depth order may not be adjacent
  std::vector<std::uint64_t> coarseBounds;  // where `coarse`, of each slot: of the depth error, key units, where it is greater than kCoarse; else 0

 private:
  // Of an object.
  struct Source {
    std::uint32_t index;                    // into objects
    std::int32_t turn;                      // -1: mirrored, its faces are turned inside out
    std::uint32_t firstPrimitive, firstBinned;   // of the object, of the one that was binned
    const Mesh* mesh;
    const glm::ivec2* vertices;             // on the grid
    const std::uint32_t* classes;           // of its facets
  };
  Source sourceOf(const Frame& frame, std::uint32_t index) const;
  void gather(const Frame& frame, Source source, std::span<const std::uint32_t> references, int at);
  void setUpBatch(const Frame& frame, int count);
  TriangleEdges edgesOfBatch(int i) const;
  DepthRange rangeOf(const TriangleSetup& t) const;   // of order values, without the error
  void drop(double farthest);
  void scaleDepths(bool decideAllExactly);

  std::span<const std::uint32_t> references_;
  EdgeBatch edges_;
  // Room for the triangles of all objects, kept from tile to tile; so many are in use. Those that have edges are kept apart until all are set up, and come
  // last: kernels then have to tell one from the other only once.
  std::vector<TileSlot> slotRoom_;
  std::vector<TriangleSetup> setupRoom_, withEdges_, sortedRoom_;
  std::vector<TriangleEdges> edgeRoom_;
  std::size_t count_ = 0, smallCount_ = 0;
  DepthExtent extent_;                      // of all setups
  std::vector<std::uint64_t> order_;        // of orderByDepth, kept for their memory
};

}  // namespace copeel::cpu
