// Included once per SIMD target by over_block.cpp; no include guard but Highway's.
#if defined(COPEEL_OVER_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_OVER_BLOCK_INL_H_
#undef COPEEL_OVER_BLOCK_INL_H_
#else
#define COPEEL_OVER_BLOCK_INL_H_
#endif

#include <hwy/highway.h>

#include "core/cpu/lanes-inl.h"
#include "core/fold/over_block.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::fold {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Red, green, blue and what the fourth lane makes of alpha, in one vector or more.
using Channels = hn::CappedTag<double, 4>;
using Floats = hn::Rebind<float, Channels>;
using Ints = hn::Rebind<std::int32_t, Channels>;
using Bytes = hn::Rebind<std::uint8_t, Channels>;

inline constexpr std::size_t kParts = 4 / hn::MaxLanes(Channels());

// OverState; the transmittance in every lane.
struct State {
  hn::Vec<Channels> color[kParts], transmittance;

  HWY_INLINE HWY_ATTR State() {
    for (auto& part : color) part = hn::Zero(Channels());
    transmittance = hn::Set(Channels(), 1.0);
  }
  HWY_INLINE HWY_ATTR bool isOpaque() const { return hn::GetLane(transmittance) == 0.0; }
};

// Puts the last channel in every lane.
HWY_INLINE HWY_ATTR auto alphaLanes() {
  alignas(32) constexpr std::int64_t kLast[] = {3, 3, 3, 3}, kOnly[] = {0, 0, 0, 0};
  return hn::SetTableIndices(Channels(), kParts == 1 ? kLast : kOnly);
}
using AlphaLanes = decltype(alphaLanes());

HWY_INLINE HWY_ATTR void blendFragment(State& state, const glm::vec4& fragment, AlphaLanes alphaLanes) {
  const Channels d;
  hn::Vec<Channels> color[kParts];
  for (std::size_t part = 0; part < kParts; ++part) color[part] = hn::PromoteTo(d, hn::LoadU(Floats(), &fragment.r + part * hn::MaxLanes(d)));
  const auto alpha = kParts == 1 ? hn::TableLookupLanes(color[0], alphaLanes) : hn::Set(d, static_cast<double>(fragment.a));
  const auto weight = hn::Mul(state.transmittance, alpha);
  for (std::size_t part = 0; part < kParts; ++part) state.color[part] = hn::Add(state.color[part], hn::Mul(color[part], weight));
  state.transmittance = hn::Mul(state.transmittance, hn::Sub(hn::Set(d, 1.0), alpha));
}

// overResult.
struct Result {
  hn::Vec<Channels> color[kParts];

  HWY_INLINE HWY_ATTR Result(const State& state, const double* background) {
    const Channels d;
    for (std::size_t part = 0; part < kParts; ++part) {
      color[part] = hn::Add(state.color[part], hn::Mul(hn::Load(d, background + part * hn::MaxLanes(d)), state.transmittance));
    }
  }
  // overLevels: no colour is beyond 255 but by rounding, and what is below 0 saturates.
  HWY_INLINE HWY_ATTR void toBytes(std::uint8_t* bytes) const {
    const Channels d;
    for (std::size_t part = 0; part < kParts; ++part) {
      const auto levels = hn::DemoteTo(Ints(), hn::Add(color[part], hn::Set(d, 0.5 + 1.0 / 8589934592.0)));
      hn::StoreU(hn::DemoteTo(Bytes(), levels), Bytes(), bytes + part * hn::MaxLanes(d));
    }
  }
};

// Where results of a row go.
struct ToPixels {
  BlendedPixel* row;

  HWY_INLINE HWY_ATTR void put(int x, const Result& result) const {
    for (std::size_t part = 0; part < kParts; ++part) {
      hn::StoreU(hn::DemoteTo(Floats(), result.color[part]), Floats(), row[x].color + part * hn::MaxLanes(Channels()));
    }
    result.toBytes(row[x].bytes);
  }
  HWY_INLINE void repeat(int x) const { row[x] = row[x - 1]; }
};

struct ToImage {
  Rgb8* row;

  HWY_INLINE HWY_ATTR void put(int x, const Result& result) const {
    std::uint8_t bytes[4];
    result.toBytes(bytes);
    __builtin_memcpy(row + x, bytes, sizeof(Rgb8));
  }
  HWY_INLINE void repeat(int x) const { row[x] = row[x - 1]; }
};

// What every pixel of a block needs, at hand.
struct Source {
  const glm::vec4* colors;
  const cpu::TileSlot* slots;
  cpu::KeyFormat format;
  std::uint64_t slotMask;
  std::uint64_t reach;      // KeyFormat's
  std::size_t stride;

  HWY_INLINE HWY_ATTR explicit Source(const OverBlock& from)
      : colors(from.colors), slots(from.tile.slots.data()), format(from.tile.keys.format), slotMask(format.slotMask()),
        reach(format.reach()), stride(from.block.stride) {}
  std::size_t slotOf(std::uint64_t key) const { return ~key & slotMask; }
  // Of two keys that are not of one plane class.
  bool areApart(std::uint64_t nearer, std::uint64_t farther) const { return format.depthOf(farther) - format.depthOf(nearer) > 2 * format.uncertainty; }
};

// How a pixel was met.
struct Met {
  std::uint32_t count = 0;   // keys that were looked at; of a pixel that ended the last one was not blended
  bool certain = false, coplanar = false;
};

// `visit(color)`, which returns false to end, for the fragments of a pixel, one or more, as far as its keys tell their order.
template <class Visit>
HWY_INLINE HWY_ATTR Met meet(const Source& from, const std::uint64_t* keys, std::uint32_t count, Visit visit) {
  bool coplanar = false;
  std::uint64_t before = *keys + 1;   // far from the first
  std::uint32_t left = count;
  do {
    const std::uint64_t key = *keys;
    const std::size_t slot = from.slotOf(key);
    if (key - before < from.reach) {
      // Those of a plane class have one depth.
      if (from.slots[slot].planeClass == from.slots[from.slotOf(before)].planeClass) coplanar = true;
      else if (!from.areApart(before, key)) return {};
    }
    if (!visit(from.colors[slot])) {
      --left;
      break;
    }
    before = key;
    keys += from.stride;
  } while (--left > 0);
  return {count - left, true, coplanar};
}

// Which of some pixels of a row have the slots of the one before, all their layers.
HWY_INLINE HWY_ATTR std::uint32_t repeatsOfRow(const Source& from, const std::uint64_t* keys, std::uint32_t layers, std::uint32_t repeats) {
  const hn::CappedTag<std::uint64_t, cpu::kBlockSize> u;
  constexpr std::uint64_t kNone = std::uint64_t{1} << cpu::kKeyBits;   // the bit that kEmptyKey has, and no key
  const auto slot = hn::Set(u, from.slotMask | kNone);
  for (std::uint32_t i = 0; i < layers && repeats; ++i, keys += from.stride) {
    std::uint32_t same = 0;
    for (std::size_t lane = 0; lane < cpu::kBlockSize; lane += hn::Lanes(u)) {
      const auto differs = hn::And(hn::Xor(hn::LoadU(u, keys + lane), hn::LoadU(u, keys + lane + 1)), slot);
      same |= cpu::HWY_NAMESPACE::bitsOf(u, hn::Eq(differs, hn::Zero(u))) << lane;
    }
    repeats &= same << 1;
  }
  return repeats;
}

// Pixels of a row with several fragments, one of them so uncertain that its neighbours in depth order may not be adjacent.
inline std::uint32_t coarseOfRow(const OverBlock& from, int row) {
  std::uint32_t coarse = 0;
  for (int x = 0; x < cpu::kBlockSize; ++x) {
    const PixelStack stack = stackOf(from.block, row * cpu::kBlockSize + x, from.tile);
    coarse |= std::uint32_t{stack.count > 1 && stack.hasCoarse()} << x;
  }
  return coarse;
}

// `to(row)`: where results of a row go.
template <bool kMayEnd, class To>
HWY_INLINE HWY_ATTR FoldedPixels blendRows(const OverBlock& block, To to) {
  const Source from(block);
  alignas(32) const double background[4] = {block.background.r, block.background.g, block.background.b, 0};
  const AlphaLanes alphaOnly = alphaLanes();
  FoldedPixels result;
  for (int row = 0; row < cpu::kBlockSize; ++row) {
    const int first = row * cpu::kBlockSize;
    const std::uint64_t* const keys = block.block.keys + first;
    const std::uint32_t* const counts = block.block.counts + first;
    std::uint32_t folded = 0xFFu & ~cpu::HWY_NAMESPACE::lanesBelow(counts, 1) & static_cast<std::uint32_t>(block.pixels >> first), coplanar = 0;
    if (block.tile.coarse) folded &= ~coarseOfRow(block, row);
    if (!folded) continue;   // the row may lie below the image
    const auto out = to(row);
    const std::uint32_t repeats = repeatsOfRow(from, keys, cpu::HWY_NAMESPACE::largestOf({counts, cpu::kBlockSize}), folded & folded << 1);
    Met met;   // by the last one that was folded
    for (std::uint32_t left = folded; left; left &= left - 1) {
      const int x = __builtin_ctz(left);
      const bool again = repeats & folded << 1 & 1u << x;
      State state;
      if (again) {
        met = meet(from, keys + x, met.count, [](const glm::vec4&) { return true; });
      } else {
        met = meet(from, keys + x, counts[x], [&state, alphaOnly](const glm::vec4& color) HWY_ATTR {
          if (kMayEnd && state.isOpaque()) return false;
          blendFragment(state, color, alphaOnly);
          return true;
        });
      }
      if (!met.certain) folded &= ~(1u << x);
      else if (again) out.repeat(x);
      else out.put(x, Result(state, background));
      if (met.coplanar) coplanar |= 1u << x;
    }
    result.folded |= std::uint64_t{folded} << first;
    result.coplanar |= std::uint64_t{coplanar} << first;
  }
  return result;
}

template <class To>
HWY_INLINE HWY_ATTR FoldedPixels blend(const OverBlock& from, To to) {
  return from.mayEnd ? blendRows<true>(from, to) : blendRows<false>(from, to);
}

HWY_ATTR FoldedPixels BlendBlock(const OverBlock& from, BlendedPixel* out) {
  return blend(from, [out](int row) { return ToPixels{out + row * cpu::kBlockSize}; });
}

HWY_ATTR FoldedPixels BlendColors(const OverBlock& from, Rgb8* first, std::ptrdiff_t rowPixels) {
  return blend(from, [=](int row) { return ToImage{first + row * rowPixels}; });
}

HWY_ATTR void ShadeSlots(const SlotShading& shadingOfTile, std::span<const cpu::TileSlot> slots, glm::vec4* colors) {
  const SlotShading shading = shadingOfTile;   // a local one stays in registers
  const hn::CappedTag<float, 4> d;
  alignas(16) constexpr float kAlpha[4] = {0, 0, 0, 1};
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const PrimitiveRange range = shading.ranges[slots[i].object];
    const float* const base = &shading.bases[range.first + range.stride * slots[i].primitive].r;
    const auto shade = hn::Set(d, shading.shades[slots[i].planeClass]);
    for (std::size_t lane = 0; lane < 4; lane += hn::Lanes(d)) {
      // Alpha is not shaded, and its limit is not the smaller one.
      const auto alpha = hn::Load(d, kAlpha + lane), factor = hn::IfThenElse(hn::Gt(alpha, hn::Zero(d)), alpha, shade);
      hn::StoreU(hn::Min(hn::Mul(hn::LoadU(d, base + lane), factor), hn::Set(d, 255.0f)), d, &colors[i].r + lane);
    }
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::fold
HWY_AFTER_NAMESPACE();

#endif
