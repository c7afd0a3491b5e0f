// The inner loops of the tile renderer: coverage and depth keys, vectorised with run-time dispatch (Google Highway: AVX-512,
// AVX2, SSE4, SSSE3, scalar). Every target gives the same bytes: coverage is exact integer arithmetic, and the depth of a lane is the same
// double operations whatever the width.
//
// A fragment is one 64-bit key: depth in the high bits; in the low ones the triangle's slot in the tile, counted from the other end. Read as a positive
// double, keys have the order of depth, then of slots from the last to the first, which makes sorting a matter of min and max. Slots follow primitive
// ids, and of coplanar fragments the later one lies in front (DESIGN.md): keys ascend front to back, and ties have one order.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "core/coplanarity/depth_planes.h"
#include "core/cpu/projection.h"
#include "core/uninitialized.h"

namespace copeel::cpu {

inline constexpr int kBlockPixels = kBlockSize * kBlockSize;
inline constexpr int kBlocksPerSide = kTileSize / kBlockSize;
inline constexpr int kBlocksPerTile = kBlocksPerSide * kBlocksPerSide;
inline constexpr int kKeyBits = 62;                 // the top two stay clear: a key is a finite positive double
inline constexpr int kMostDepthBits = 48;
inline constexpr std::uint64_t kEmptyKey = 0x7FE0000000000000ull;   // greater than every key (2^1023 as a double)

// Of a triangle in a tile. Pixels count from the tile's upper left sample; e = a·x + b·y + c >= 0 on the inner side of an edge, with the
// top-left rule folded into c.
struct TriangleEdges {
  std::int32_t a[3], b[3], c[3];
  std::int32_t samples;             // about how many it covers
};

// A triangle in a tile.
struct alignas(16) TriangleSetup {
  std::uint8_t x0, y0, x1, y1;      // bounds of covered samples, inclusive
  std::uint32_t planeClass;
  std::uint32_t cover;              // of small triangles, of the others
  std::uint32_t slot;

  static constexpr int kSmall = 4;                       // samples: small triangles have bounds of so many columns and rows at most
  static constexpr std::uint32_t kHasEdges = 1u << 31;   // others have edges: where they lie
  bool hasEdges() const { return cover & kHasEdges; }
  std::uint32_t edges() const { return cover & ~kHasEdges; }
  // Bit x + 4·y: sample (x0 + x, y0 + y) is covered.
  std::uint32_t covered() const { return cover & 0xFFFF; }
  std::uint32_t place() const { return cover >> 16; }    // of (x0, y0): placeOf
};
static_assert(sizeof(TriangleSetup) == 16);

// Pixels of a tile lie block by block: this is one's place, kBlockPixels times the block and the pixel in it.
constexpr std::uint32_t placeOf(unsigned x, unsigned y) {
  const unsigned block = y / kBlockSize * kBlocksPerSide + x / kBlockSize;
  return block * kBlockPixels + y % kBlockSize * kBlockSize + x % kBlockSize;
}

// What a fold may want to know of a triangle.
struct TileSlot {
  std::uint32_t primitive;
  std::uint32_t planeClass;
  std::uint32_t object;          // index into Tile::objects
  std::int32_t side;             // +1 entered here (front-facing), -1 left here
};

inline constexpr std::uint64_t kNoLimit = ~std::uint64_t{0};   // of depths of keys

struct KeyFormat {
  int depthBits = 40;               // slot bits are the rest of kKeyBits
  std::uint64_t uncertainty = 0;    // bound of the error of a depth, key units, of every slot that is not coarse (tile.h)
  int slotBits() const { return kKeyBits - depthBits; }
  // Keys so far from each other, or farther, have depths that are certainly apart.
  std::uint64_t reach() const { return (2 * uncertainty + 2) << slotBits(); }
  std::uint64_t depthOf(std::uint64_t key) const { return key >> slotBits(); }
  std::uint64_t slotMask() const { return (std::uint64_t{1} << slotBits()) - 1; }
  std::uint32_t slotOf(std::uint64_t key) const { return static_cast<std::uint32_t>(~key & slotMask()); }
  std::uint64_t lowBitsOf(std::uint32_t slot) const { return ~std::uint64_t{slot} & slotMask(); }   // of a key
};

inline constexpr double kBias = 4503599627370496.0;   // 2^52: beyond it a double counts whole numbers

// What setups of a tile are told from: edges, and what makes keys of them.
struct TileKeys {
  KeyFormat format;
  const DepthPlane* planes = nullptr;     // by plane class
  const TriangleEdges* edges = nullptr;   // of those that have any
  double least = 0, most = 0;             // order values of the tile
  double scale = 1;                       // key units of one
  // Of columns and rows, in the planes' coordinates. Some may be read from any on.
  double u[kTileSize + kBlockSize], v[kTileSize + TriangleSetup::kSmall];

  const TriangleEdges& edgesOf(const TriangleSetup& t) const { return edges[t.edges()]; }
  const DepthPlane& planeOf(const TriangleSetup& t) const { return planes[t.planeClass]; }
  std::int32_t samplesOf(const TriangleSetup& t) const { return t.hasEdges() ? edgesOf(t).samples : std::popcount(t.covered()); }
};

// The order value before it is clamped. x, y: a pixel of the tile.
inline double orderAt(const DepthPlane& plane, const TileKeys& keys, int x, int y) { return plane.a * keys.u[x] + (plane.b * keys.v[y] + plane.c); }

inline std::uint64_t keyAt(const TriangleSetup& t, int x, int y, const TileKeys& keys) {
  const DepthPlane& plane = keys.planeOf(t);
  const double least = std::max<double>(plane.lo, keys.least), most = std::min<double>(plane.hi, keys.most);
  const double order = std::min(std::max(orderAt(plane, keys, x, y), least), most);
  // The mantissa of 2^52 + n is n: shifted up it loses exponent and sign, shifted back it leaves the two clear bits of a key.
  const auto bits = std::bit_cast<std::uint64_t>((order - keys.least) * keys.scale + kBias);
  return (bits << (64 - keys.format.depthBits)) >> (64 - kKeyBits) | keys.format.lowBitsOf(t.slot);
}

// A range of blocks of a tile: [bx0, bx1) × [by0, by1).
struct BlockRect {
  int bx0 = 0, by0 = 0, bx1 = kBlocksPerSide, by1 = kBlocksPerSide;
  int count() const { return (bx1 - bx0) * (by1 - by0); }
};

// The fragments of a block's pixels where they are kept.
struct FragmentBlock {
  std::uint64_t* keys;                       // of its first pixel; keys[layer · stride + pixel], and one more may be read after the last pixel
  std::uint32_t* counts;                     // [64], fragments per pixel
  std::uint32_t stride;                      // keys from one layer to the next

  std::uint64_t* layer(std::size_t i) const { return keys + i * stride; }
  bool empty() const {
    std::uint32_t any = 0;
    for (int p = 0; p < kBlockPixels; ++p) any |= counts[p];
    return any == 0;
  }
};

// All fragments of the pixels of a tile or of one block, layer by layer.
class FragmentGrid {
 public:
  explicit FragmentGrid(std::size_t budgetBytes) : budgetBytes_(budgetBytes) {}

  // Empties it, for a tile or for one block; the budget does not apply to a block.
  void begin(const BlockRect& rect);
  FragmentBlock block(int index) {
    const std::uint32_t place = static_cast<std::uint32_t>(index) * kBlockPixels;
    return {keys_.data() + (place - origin_), counts_ + place, stride_};
  }
  std::span<const std::uint32_t> counts() const { return counts_; }   // of all blocks; 0 outside what was begun

  // A pixel's fragments, by its place (placeOf): keys[layer · stride + place - origin], and so many as counts[place]. Places run from `origin` on.
  struct Layout {
    std::uint32_t* counts;
    std::uint32_t stride, origin, pixels;
  };
  Layout layout() { return {counts_, stride_, origin_, static_cast<std::uint32_t>(isBlock() ? kBlockPixels : kBlocksPerTile * kBlockPixels)}; }

  // Where fragments are added until there is no more room.
  struct Room {
    std::uint64_t* keys;
    std::size_t left;                        // layers that may be added to every pixel; 0: the budget is spent
  };
  Room room(std::uint32_t used);             // layers in use

 private:
  // Layers of a tile lie so far apart that those of a pixel do not compete for the same lines of a cache.
  static constexpr std::uint32_t kTileStride = kBlocksPerTile * kBlockPixels + 8;

  bool isBlock() const { return stride_ == kBlockPixels; }
  bool grow(std::size_t least);              // to so many layers

  UninitializedVector<std::uint64_t> keys_;  // kept from tile to tile
  std::uint32_t counts_[kBlocksPerTile * kBlockPixels] = {};
  std::uint32_t origin_ = 0, stride_ = kTileStride;
  std::uint32_t capacity_ = 0;               // layers
  std::size_t budgetBytes_, limitBytes_ = 0;
};

// Appends the fragments of the triangles to the grid, begun with the same rectangle: a tile or one block. Blocks with a bit in `finished` are
// passed over. False when the grid could not grow.
bool collectFragments(std::span<const TriangleSetup> triangles, const TileKeys& keys, const BlockRect& rect, std::uint32_t finished,
                      FragmentGrid& grid);

struct PixelCounts {
  std::uint64_t fragments = 0, captured = 0, covered = 0;
  std::uint32_t most = 0;
};
// Of pixels with so many fragments each, less than 2^25, of which `nearest` at most are captured; of one block or of several.
PixelCounts countPixels(std::span<const std::uint32_t> counts, std::uint32_t nearest);

// The plain z-buffer: keeps the least key of each pixel, nearest[block][64], which the caller has filled with kEmptyKey.
void collectNearest(std::span<const TriangleSetup> triangles, const TileKeys& keys, std::uint64_t* nearest);

// The K nearest fragments of the pixels of a tile: a buffer of K keys a pixel, ascending. What a full buffer has no place for is counted.
//
// Based on: Bavoil, Callahan, Lefohn, Comba, Silva. Multi-Fragment Effects on the GPU Using the k-Buffer. I3D 2007. Vasilakis, Fudos. k⁺-buffer:
// Fragment Synchronized k-buffer. I3D 2014: a fragment farther than all that are kept turns back at once.
// Changed: a tile is one thread's, so nothing has to be kept apart; rows of eight pixels are turned back together.
class NearestGrid {
 public:
  struct Block {
    std::unique_ptr<std::uint64_t[]> keys;   // [k][64]
    std::uint32_t counts[kBlockPixels];      // fragments kept
    std::uint32_t seen[kBlockPixels];        // fragments that came, kept or not
    std::uint64_t doubtful;                  // pixels in which keys leave open whether what was lost is nearer than what was kept

    FragmentBlock kept() { return {keys.get(), counts, kBlockPixels}; }
  };

  explicit NearestGrid(std::uint32_t k) : k_(k) {}

  void clear();
  std::uint32_t k() const { return k_; }
  Block& block(std::size_t index) { return blocks_[index]; }

 private:
  std::uint32_t k_;
  Block blocks_[kBlocksPerTile];
};

// What tells two keys' planes apart, and when they have to be.
struct KeyDoubt {
  std::uint64_t reach;       // keys less than this apart may be in either order, if their planes differ
  const TileSlot* slots;
};

void collectKNearest(std::span<const TriangleSetup> triangles, const TileKeys& keys, const KeyDoubt& doubt, NearestGrid& grid);

// Restricts the targets to those at most as wide as named: "best", "avx2", "sse4", "scalar". For tests; not to be called while drawing.
void chooseSimd(const char* name);
const char* simdInUse();   // Highway's name of the target that the kernels run on

}  // namespace copeel::cpu
