// Included once per SIMD target by kernels.cpp; no include guard but Highway's.
#if defined(COPEEL_KERNELS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_KERNELS_INL_H_
#undef COPEEL_KERNELS_INL_H_
#else
#define COPEEL_KERNELS_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/kernels.h"
#include "core/cpu/lanes-inl.h"
#include "core/cpu/tile.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using I32 = hn::CappedTag<std::int32_t, kBlockSize>;
using F64 = hn::CappedTag<double, kBlockSize>;
using U64 = hn::CappedTag<std::uint64_t, kBlockSize>;

alignas(64) inline constexpr std::int32_t kIotaInt[kBlockSize] = {0, 1, 2, 3, 4, 5, 6, 7};

// Samples of 8×8 that a triangle's bounds hold: rows y0 … y1, and their columns in every row.
struct Within {
  int y0, y1;
  std::uint64_t columns;

  HWY_INLINE std::uint64_t all() const { return columns & (~std::uint64_t{0} >> (kBlockSize * (7 - y1 + y0))) << (kBlockSize * y0); }
};

inline constexpr std::uint64_t kFirstColumn = 0x0101010101010101ull;

// From (x, y) on.
HWY_INLINE Within within(const TriangleSetup& t, int x, int y) {
  const int x0 = t.x0 > x ? t.x0 - x : 0, x1 = t.x1 - x < kBlockSize - 1 ? t.x1 - x : kBlockSize - 1;
  const int y0 = t.y0 > y ? t.y0 - y : 0, y1 = t.y1 - y < kBlockSize - 1 ? t.y1 - y : kBlockSize - 1;
  return {y0, y1, ((0xFFull >> (7 - x1 + x0)) << x0) * kFirstColumn};
}

// The same where the bounds begin at (x, y) or before.
HWY_INLINE Within withinRest(const TriangleSetup& t, int x, int y) {
  const int x1 = t.x1 - x < kBlockSize - 1 ? t.x1 - x : kBlockSize - 1, y1 = t.y1 - y < kBlockSize - 1 ? t.y1 - y : kBlockSize - 1;
  return {0, y1, (0xFFull >> (7 - x1)) * kFirstColumn};
}

// Of 8×8 samples from (x, y) on: bit 8·row + column is set where all three edges are not negative. Edges that the triangle's bounds make redundant were
// dropped, so the bounds count.
HWY_INLINE HWY_ATTR std::uint64_t coverage(const TriangleEdges& edges, int x, int y, const Within& bounds) {
  const I32 d;
  const std::size_t lanes = hn::Lanes(d);
  const auto ys = hn::Set(d, y + bounds.y0);
  std::uint64_t bits = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += lanes) {
    const auto xs = hn::Add(hn::Set(d, x), hn::Load(d, kIotaInt + lane));
    const auto b0 = hn::Set(d, edges.b[0]), b1 = hn::Set(d, edges.b[1]), b2 = hn::Set(d, edges.b[2]);
    auto e0 = hn::Add(hn::Add(hn::Mul(hn::Set(d, edges.a[0]), xs), hn::Mul(b0, ys)), hn::Set(d, edges.c[0]));
    auto e1 = hn::Add(hn::Add(hn::Mul(hn::Set(d, edges.a[1]), xs), hn::Mul(b1, ys)), hn::Set(d, edges.c[1]));
    auto e2 = hn::Add(hn::Add(hn::Mul(hn::Set(d, edges.a[2]), xs), hn::Mul(b2, ys)), hn::Set(d, edges.c[2]));
    // Unrolled, it costs small triangles more than it saves.
#pragma GCC unroll 1
    for (int row = bounds.y0; row <= bounds.y1; ++row) {
      const auto outside = hn::Lt(hn::Or(hn::Or(e0, e1), e2), hn::Zero(d));
      bits |= std::uint64_t{bitsOf(d, hn::Not(outside))} << (row * kBlockSize + lane);
      e0 = hn::Add(e0, b0), e1 = hn::Add(e1, b1), e2 = hn::Add(e2, b2);
    }
  }
  return bits & bounds.columns;
}

// Of a block. x, y: its first pixel in the tile.
HWY_INLINE HWY_ATTR std::uint64_t blockCoverage(const TriangleSetup& t, const TriangleEdges& edges, int x, int y) {
  bool full = true;
  for (int i = 0; i < 3; ++i) {
    const std::int32_t first = edges.a[i] * x + edges.b[i] * y + edges.c[i];
    const std::int32_t across = (kBlockSize - 1) * edges.a[i], down = (kBlockSize - 1) * edges.b[i];
    if (first + (across > 0 ? across : 0) + (down > 0 ? down : 0) < 0) return 0;
    full &= first + (across < 0 ? across : 0) + (down < 0 ? down : 0) >= 0;
  }
  const Within bounds = within(t, x, y);
  return full ? bounds.all() : coverage(edges, x, y, bounds);
}

// keyAt of a triangle, so many pixels of a row at once.
template <int kCount>
class RowKeys {
 public:
  // slotMask: KeyFormat's, as finding it takes as long as a row.
  HWY_INLINE HWY_ATTR RowKeys(const TriangleSetup& t, const TileKeys& keys, std::uint64_t slotMask)
      : u_(keys.u), v_(keys.v), up_(64 - keys.format.depthBits) {
    const DepthPlane& plane = keys.planeOf(t);
    const D d;
    a_ = hn::Set(d, plane.a), b_ = hn::Set(d, plane.b), c_ = hn::Set(d, plane.c);
    origin_ = hn::Set(d, keys.least), scale_ = hn::Set(d, keys.scale);
    least_ = hn::Max(hn::Set(d, static_cast<double>(plane.lo)), origin_);
    most_ = hn::Min(hn::Set(d, static_cast<double>(plane.hi)), hn::Set(d, keys.most));
    slot_ = hn::Set(U(), t.slot ^ slotMask);
  }
  // x, y: the first pixel in the tile.
  HWY_INLINE HWY_ATTR void put(int x, int y, std::uint64_t* out) const {
    const D d;
    const auto base = hn::Add(hn::Mul(b_, hn::Set(d, v_[y])), c_);
    for (std::size_t lane = 0; lane < kCount; lane += hn::Lanes(d)) {
      const auto order = hn::Min(hn::Max(hn::Add(hn::Mul(a_, hn::LoadU(d, u_ + x + lane)), base), least_), most_);
      const auto depth = hn::Add(hn::Mul(hn::Sub(order, origin_), scale_), hn::Set(d, kBias));
      const auto bits = hn::ShiftRight<64 - kKeyBits>(hn::ShiftLeftSame(hn::BitCast(U(), depth), up_));
      hn::Store(hn::Or(bits, slot_), U(), out + lane);
    }
  }

 private:
  using D = hn::CappedTag<double, kCount>;
  using U = hn::CappedTag<std::uint64_t, kCount>;

  const double *u_, *v_;
  int up_;
  hn::Vec<D> a_, b_, c_, origin_, scale_, least_, most_;
  hn::Vec<U> slot_;
};

// A triangle whose bounds hold no more samples than a block is taken sample by sample, whatever blocks it lies in.
HWY_INLINE bool isBySample(const TriangleSetup& t) { return !t.hasEdges() || (t.x1 - t.x0 + 1) * (t.y1 - t.y0 + 1) <= kBlockPixels; }

// steps[pixel][kWidth·row + column]: how many places the sample so many columns and rows on lies after one that is so in its block. Small triangles lie
// in two to four blocks as often as in one, and looking up costs less than telling them apart.
template <unsigned kWidth>
struct PlaceSteps {
  std::uint16_t steps[kBlockPixels][kWidth * kWidth];
};
template <unsigned kWidth>
constexpr PlaceSteps<kWidth> placeSteps() {
  PlaceSteps<kWidth> table{};
  for (unsigned pixel = 0; pixel < kBlockPixels; ++pixel) {
    const unsigned x = pixel % kBlockSize, y = pixel / kBlockSize;
    for (unsigned bit = 0; bit < kWidth * kWidth; ++bit) {
      table.steps[pixel][bit] = static_cast<std::uint16_t>(placeOf(x + bit % kWidth, y + bit / kWidth) - placeOf(x, y));
    }
  }
  return table;
}
template <unsigned kWidth>
alignas(64) inline constexpr PlaceSteps<kWidth> kPlaceSteps = placeSteps<kWidth>();

// `visit(place, key)` for samples of a square, kWidth in a row, the first one at `first`. covered: bit kWidth·row + column, as are the keys.
template <unsigned kWidth, class Visit>
HWY_INLINE HWY_ATTR void forEachCovered(std::uint32_t first, std::uint64_t covered, const std::uint64_t* keys, Visit visit) {
  const std::uint16_t* const steps = kPlaceSteps<kWidth>.steps[first % kBlockPixels];
  for (; covered; covered &= covered - 1) {
    const int bit = __builtin_ctzll(covered);
    visit(first + steps[bit], keys[bit]);
  }
}

// Keys of rows 0 … last, kBlockSize apart, from (x, y) on.
template <int kCount>
HWY_INLINE HWY_ATTR void keysOfRows(const RowKeys<kCount>& ofRow, int x, int y, int last, std::uint64_t* found) {
#pragma GCC unroll 1
  for (int row = 0; row <= last; ++row) ofRow.put(x, y + row, found + kBlockSize * row);
}

// In windows of 8×8 from the corner of its bounds on, of which nearly every triangle needs one.
template <class Visit>
HWY_NOINLINE HWY_ATTR void visitWindows(const TriangleSetup& t, const TileKeys& keys, std::uint64_t slotMask, Visit visit) {
  const TriangleEdges& edges = keys.edgesOf(t);
  alignas(64) std::uint64_t found[kBlockPixels];
  for (int y = t.y0; y <= t.y1; y += kBlockSize) {
    for (int x = t.x0; x <= t.x1; x += kBlockSize) {
      const Within bounds = withinRest(t, x, y);
      const std::uint64_t covered = coverage(edges, x, y, bounds);
      if (t.x1 - x < 4) keysOfRows(RowKeys<4>(t, keys, slotMask), x, y, bounds.y1, found);
      else keysOfRows(RowKeys<kBlockSize>(t, keys, slotMask), x, y, bounds.y1, found);
      forEachCovered<kBlockSize>(placeOf(static_cast<unsigned>(x), static_cast<unsigned>(y)), covered, found, visit);
    }
  }
}

// `visit(place, key)` for the samples of a triangle that is taken sample by sample.
template <class Visit>
HWY_INLINE HWY_ATTR void forEachSample(const TriangleSetup& t, const TileKeys& keys, std::uint64_t slotMask, Visit visit) {
  if (t.hasEdges()) return visitWindows(t, keys, slotMask, visit);
  constexpr int kSmall = TriangleSetup::kSmall;
  alignas(64) std::uint64_t found[kSmall * kSmall];
  const RowKeys<kSmall> ofRow(t, keys, slotMask);
  // All rows: how many there are would be guessed wrong too often.
  for (int row = 0; row < kSmall; ++row) ofRow.put(t.x0, t.y0 + row, found + kSmall * row);
  forEachCovered<kSmall>(t.place(), t.covered(), found, visit);
}

// `visit(block, x, y, covered)` for blocks of the rectangle that are not in `closed`. x, y: the block's first pixel in the tile.
template <class Visit>
HWY_INLINE HWY_ATTR void forEachBlock(const TriangleSetup& t, const TriangleEdges& edges, const BlockRect& rect, std::uint32_t closed, const Visit& visit) {
  const int bx0 = std::max(t.x0 / kBlockSize, rect.bx0), bx1 = std::min(t.x1 / kBlockSize + 1, rect.bx1);
  const int by0 = std::max(t.y0 / kBlockSize, rect.by0), by1 = std::min(t.y1 / kBlockSize + 1, rect.by1);
  for (int by = by0; by < by1; ++by) {
    for (int bx = bx0; bx < bx1; ++bx) {
      const int index = by * kBlocksPerSide + bx;
      if (closed >> index & 1) continue;
      const std::uint64_t covered = blockCoverage(t, edges, bx * kBlockSize, by * kBlockSize);
      if (covered) visit(index, bx * kBlockSize, by * kBlockSize, covered);
    }
  }
}

// While fragments are added: where the next key of each pixel goes. Counts would cost a fragment a multiplication.
class NextKeys {
 public:
  HWY_ATTR explicit NextKeys(const FragmentGrid::Layout& layout) : layout_(layout) {
    const D d;
    for (std::uint32_t i = 0; i < layout.pixels; i += hn::Lanes(d)) {
      const auto layers = hn::LoadU(d, layout.counts + layout.origin + i);
      hn::StoreU(hn::Add(hn::Mul(layers, hn::Set(d, layout.stride)), first(i)), d, at_ + layout.origin + i);
    }
  }
  HWY_INLINE void add(std::uint32_t place, std::uint64_t key, std::uint64_t* keys) {
    const std::uint32_t at = at_[place];
    keys[at] = key;
    at_[place] = at + layout_.stride;
  }
  // Eight keys of a row, if its pixels have as many each.
  HWY_INLINE HWY_ATTR bool addRow(std::uint32_t place, const std::uint64_t* row, std::uint64_t* keys) {
    std::uint32_t* const next = at_ + place;
    const std::uint32_t at = next[0];
    std::uint32_t differ = 0;
    for (std::uint32_t k = 1; k < kBlockSize; ++k) differ |= next[k] ^ (at + k);
    if (differ) return false;
    __builtin_memcpy(keys + at, row, sizeof(std::uint64_t) * kBlockSize);
    for (std::uint32_t k = 0; k < kBlockSize; ++k) next[k] = at + layout_.stride + k;
    return true;
  }
  // The most of a pixel.
  HWY_ATTR std::uint32_t layers() const {
    const D d;
    auto most = hn::Zero(d);
    for (std::uint32_t i = 0; i < layout_.pixels; i += hn::Lanes(d)) most = hn::Max(most, used(i));
    return hn::GetLane(hn::MaxOfLanes(d, most)) / layout_.stride;
  }
  HWY_ATTR void putCounts() const {
    const D d;
    // Of a multiple of an odd number a multiplication modulo 2^32 is the quotient. Newton's iteration doubles the bits that are right, three to begin with.
    const int shift = __builtin_ctz(layout_.stride);
    const std::uint32_t odd = layout_.stride >> shift;
    std::uint32_t inverse = odd;
    for (int bits = 3; bits < 32; bits *= 2) inverse *= 2 - odd * inverse;
    for (std::uint32_t i = 0; i < layout_.pixels; i += hn::Lanes(d)) {
      hn::StoreU(hn::Mul(hn::ShiftRightSame(used(i), shift), hn::Set(d, inverse)), d, layout_.counts + layout_.origin + i);
    }
  }

 private:
  using D = hn::CappedTag<std::uint32_t, kBlockSize>;

  // Of the pixels at i: the place of the first key; how far the next one lies from it.
  static HWY_INLINE HWY_ATTR hn::Vec<D> first(std::uint32_t i) {
    return hn::Add(hn::Set(D(), i), hn::BitCast(D(), hn::Load(hn::RebindToSigned<D>(), kIotaInt)));   // hn::Iota goes through memory
  }
  HWY_INLINE HWY_ATTR hn::Vec<D> used(std::uint32_t i) const { return hn::Sub(hn::LoadU(D(), at_ + layout_.origin + i), first(i)); }

  FragmentGrid::Layout layout_;
  std::uint32_t at_[kBlocksPerTile * kBlockPixels];   // from the origin on
};

// kClosed: blocks with a bit in `closed` are passed over.
template <bool kClosed>
HWY_ATTR void collectInRoom(std::span<const TriangleSetup> triangles, const TileKeys& keys, const BlockRect& rect, std::uint32_t closed, NextKeys& next,
                            std::uint64_t* out) {
  const auto add = [&next, out, closed](std::uint32_t place, std::uint64_t key) HWY_ATTR {
    if (!kClosed || !(closed >> (place / kBlockPixels) & 1)) next.add(place, key, out);
  };
  const std::uint64_t slotMask = keys.format.slotMask();
  for (const TriangleSetup& t : triangles) {
    if (isBySample(t)) {
      forEachSample(t, keys, slotMask, add);
      continue;
    }
    const RowKeys<kBlockSize> ofRow(t, keys, slotMask);
    forEachBlock(t, keys.edgesOf(t), rect, closed, [&](int index, int x, int y, std::uint64_t covered) HWY_ATTR {
      for (int row = __builtin_ctzll(covered) / kBlockSize; row < kBlockSize; ++row) {
        std::uint32_t mask = covered >> (row * kBlockSize) & 0xFF;
        if (!mask) continue;
        alignas(64) std::uint64_t found[kBlockSize];
        ofRow.put(x, y + row, found);
        const std::uint32_t place = static_cast<std::uint32_t>(index * kBlockPixels + row * kBlockSize);
        if (mask == 0xFF && next.addRow(place, found, out)) continue;
        for (; mask; mask &= mask - 1) {
          const unsigned k = static_cast<unsigned>(__builtin_ctz(mask));
          next.add(place + k, found[k], out);
        }
      }
    });
  }
}

// A triangle adds one fragment to a pixel at most.
HWY_ATTR bool CollectFragments(std::span<const TriangleSetup> triangles, const TileKeys& keys, const BlockRect& rect, std::uint32_t finished,
                               FragmentGrid& grid) {
  // Bounds of triangles do not reach beyond a tile.
  const std::uint32_t closed = rect.count() == 1 ? ~(1u << (rect.by0 * kBlocksPerSide + rect.bx0)) : finished;
  NextKeys next(grid.layout());
  while (!triangles.empty()) {
    const FragmentGrid::Room room = grid.room(next.layers());
    if (room.left == 0) break;
    const auto some = triangles.first(std::min(triangles.size(), room.left));
    if (closed) collectInRoom<true>(some, keys, rect, closed, next, room.keys);
    else collectInRoom<false>(some, keys, rect, closed, next, room.keys);
    triangles = triangles.subspan(some.size());
  }
  next.putCounts();
  return triangles.empty();
}

HWY_ATTR PixelCounts CountPixels(std::span<const std::uint32_t> counts, std::uint32_t nearest) {
  const hn::CappedTag<std::uint32_t, kBlockSize> d;
  auto fragments = hn::Zero(d), captured = hn::Zero(d), covered = hn::Zero(d), most = hn::Zero(d);
  for (std::size_t i = 0; i < counts.size(); i += hn::Lanes(d)) {
    const auto count = hn::LoadU(d, counts.data() + i);
    fragments = hn::Add(fragments, count);
    captured = hn::Add(captured, hn::Min(count, hn::Set(d, nearest)));
    covered = hn::Add(covered, hn::Min(count, hn::Set(d, 1)));
    most = hn::Max(most, count);
  }
  const auto sum = [d](auto lanes) HWY_ATTR {
    std::uint32_t each[kBlockSize];
    hn::StoreU(lanes, d, each);
    return std::accumulate(each, each + hn::Lanes(d), std::uint64_t{0});
  };
  return {sum(fragments), sum(captured), sum(covered), hn::GetLane(hn::MaxOfLanes(d, most))};
}

HWY_ATTR void CollectNearest(const TriangleSetup* triangles, std::size_t count, const TileKeys& keys, std::uint64_t* nearest) {
  const auto keep = [&](std::uint32_t place, std::uint64_t key) HWY_ATTR { nearest[place] = std::min(nearest[place], key); };
  const std::uint64_t slotMask = keys.format.slotMask();
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleSetup& t = triangles[i];
    if (isBySample(t)) {
      forEachSample(t, keys, slotMask, keep);
      continue;
    }
    const RowKeys<kBlockSize> ofRow(t, keys, slotMask);
    forEachBlock(t, keys.edgesOf(t), BlockRect{}, 0, [&](int index, int x, int y, std::uint64_t covered) HWY_ATTR {
      for (int row = __builtin_ctzll(covered) / kBlockSize; row < kBlockSize; ++row) {
        const std::uint32_t mask = covered >> (row * kBlockSize) & 0xFF;
        if (!mask) continue;
        alignas(64) std::uint64_t found[kBlockSize];
        ofRow.put(x, y + row, found);
        std::uint64_t* pixels = nearest + index * kBlockPixels + row * kBlockSize;
        for (int k = 0; k < kBlockSize; ++k) {
          const std::uint64_t key = mask >> k & 1 ? found[k] : kEmptyKey;
          pixels[k] = key < pixels[k] ? key : pixels[k];
        }
      }
    });
  }
}

// Two planes whose keys do not tell their order.
inline bool isOpen(std::uint64_t nearer, std::uint64_t farther, KeyFormat format, const KeyDoubt& doubt) {
  if (farther - nearer >= doubt.reach) return false;
  return doubt.slots[format.slotOf(nearer)].planeClass != doubt.slots[format.slotOf(farther)].planeClass;
}

// A key that is nearer than the last, or as good as that: to its place among those kept.
inline void keepNearest(NearestGrid::Block& block, std::uint32_t k, int pixel, std::uint64_t key, KeyFormat format, const KeyDoubt& doubt) {
  std::uint64_t* keys = block.keys.get() + pixel;
  std::uint64_t& last = keys[std::size_t{k - 1} * kBlockPixels];
  std::uint32_t& count = block.counts[pixel];
  std::uint64_t lost = kEmptyKey;
  if (key < last) {
    lost = last;
    std::uint32_t at = count < k ? count++ : k - 1;
    for (; at > 0 && keys[std::size_t{at - 1} * kBlockPixels] > key; --at) keys[std::size_t{at} * kBlockPixels] = keys[std::size_t{at - 1} * kBlockPixels];
    keys[std::size_t{at} * kBlockPixels] = key;
  } else {
    lost = key;
  }
  if (lost != kEmptyKey && isOpen(last, lost, format, doubt)) block.doubtful |= std::uint64_t{1} << pixel;
}

// Which of eight keys may have a place before `last`.
HWY_INLINE HWY_ATTR std::uint32_t mayBeKept(const std::uint64_t* keys, const std::uint64_t* last, std::uint64_t reach) {
  const F64 d;
  const U64 u;
  std::uint32_t mask = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    const auto limit = hn::Add(hn::LoadU(u, last + lane), hn::Set(u, reach));
    mask |= bitsOf(d, hn::Lt(hn::BitCast(d, hn::Load(u, keys + lane)), hn::BitCast(d, limit))) << lane;
  }
  return mask;
}

HWY_ATTR void CollectKNearest(const TriangleSetup* triangles, std::size_t count, const TileKeys& keys, const KeyDoubt& doubt, NearestGrid& grid) {
  const std::uint32_t k = grid.k();
  const std::size_t lastLayer = std::size_t{k - 1} * kBlockPixels;
  const auto keep = [&](std::uint32_t place, std::uint64_t key) HWY_ATTR {
    NearestGrid::Block& block = grid.block(place / kBlockPixels);
    const std::uint32_t pixel = place % kBlockPixels;
    ++block.seen[pixel];
    if (key < block.keys[lastLayer + pixel] + doubt.reach) keepNearest(block, k, static_cast<int>(pixel), key, keys.format, doubt);
  };
  const std::uint64_t slotMask = keys.format.slotMask();
  for (std::size_t i = 0; i < count; ++i) {
    const TriangleSetup& t = triangles[i];
    if (isBySample(t)) {
      forEachSample(t, keys, slotMask, keep);
      continue;
    }
    const RowKeys<kBlockSize> ofRow(t, keys, slotMask);
    forEachBlock(t, keys.edgesOf(t), BlockRect{}, 0, [&](int index, int x, int y, std::uint64_t covered) HWY_ATTR {
      NearestGrid::Block& block = grid.block(index);
      for (int row = __builtin_ctzll(covered) / kBlockSize; row < kBlockSize; ++row) {
        std::uint32_t mask = covered >> (row * kBlockSize) & 0xFF;
        if (!mask) continue;
        alignas(64) std::uint64_t found[kBlockSize];
        ofRow.put(x, y + row, found);
        for (int lane = 0; lane < kBlockSize; ++lane) block.seen[row * kBlockSize + lane] += mask >> lane & 1;
        mask &= mayBeKept(found, block.keys.get() + lastLayer + row * kBlockSize, doubt.reach);
        for (; mask; mask &= mask - 1) {
          const int lane = __builtin_ctz(mask);
          keepNearest(block, k, row * kBlockSize + lane, found[lane], keys.format, doubt);
        }
      }
    });
  }
}

const char* SimdName() { return hwy::TargetName(HWY_TARGET); }

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
