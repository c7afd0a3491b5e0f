// Included once per SIMD target by over_block.cpp; no include guard but Highway's.
#if defined(COPEEL_OVER_BLOCK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_OVER_BLOCK_INL_H_
#undef COPEEL_OVER_BLOCK_INL_H_
#else
#define COPEEL_OVER_BLOCK_INL_H_
#endif

#include <hwy/highway.h>

#include "core/fold/over_block.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::fold {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Red, green, blue and what the fourth lane makes of alpha, in one vector or two.
using Channels = hn::CappedTag<double, 4>;
using Floats = hn::Rebind<float, Channels>;
using Ints = hn::Rebind<std::int32_t, Channels>;
using Bytes = hn::Rebind<std::uint8_t, Channels>;

inline constexpr std::size_t kParts = 4 / hn::MaxLanes(Channels());

// OverState.
struct State {
  hn::Vec<Channels> color[kParts];
  double transmittance = 1;
};

HWY_INLINE HWY_ATTR void blendFragment(State& state, const glm::vec4& fragment) {
  const Channels d;
  const double alpha = fragment.a;
  const auto weight = hn::Set(d, state.transmittance * alpha);
  for (std::size_t part = 0; part < kParts; ++part) {
    const auto color = hn::PromoteTo(d, hn::LoadU(Floats(), &fragment.r + part * hn::MaxLanes(d)));
    state.color[part] = hn::Add(state.color[part], hn::Mul(color, weight));
  }
  state.transmittance *= 1.0 - alpha;
}

// overResult.
struct Result {
  hn::Vec<Channels> color[kParts];

  HWY_INLINE HWY_ATTR Result(const State& state, const double* background) {
    const Channels d;
    for (std::size_t part = 0; part < kParts; ++part) {
      color[part] = hn::Add(state.color[part], hn::Mul(hn::Load(d, background + part * hn::MaxLanes(d)), hn::Set(d, state.transmittance)));
    }
  }
  // overLevels.
  HWY_INLINE HWY_ATTR void toBytes(std::uint8_t* bytes) const {
    const Channels d;
    for (std::size_t part = 0; part < kParts; ++part) {
      const auto clamped = hn::Min(hn::Max(color[part], hn::Zero(d)), hn::Set(d, 255.0));
      const auto levels = hn::DemoteTo(Ints(), hn::Add(clamped, hn::Set(d, 0.5 + 1.0 / 8589934592.0)));
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
  std::uint64_t slotMask;
  std::size_t stride;
  cpu::KeyFormat format;
  bool mayEnd;

  HWY_INLINE HWY_ATTR explicit Source(const OverBlock& from)
      : colors(from.colors), slotMask(from.format.slotMask()), stride(from.block.stride), format(from.format), mayEnd(from.mayEnd) {}
  HWY_INLINE const glm::vec4& colorOf(std::uint64_t key) const { return colors[~key & slotMask]; }
};

// Returns how many fragments were met.
template <bool kMayEnd>
HWY_INLINE HWY_ATTR std::uint32_t blendFragments(const Source& from, const std::uint64_t* key, std::uint32_t count, State& state) {
  for (std::uint32_t i = 0; i < count; ++i, key += from.stride) {
    blendFragment(state, from.colorOf(*key));
    if (kMayEnd && state.transmittance == 0.0) return i + 1;
  }
  return count;
}

// Some of the first `met` fragments of a pixel have others at their depth.
inline bool meetsCoplanar(const Source& from, const std::uint64_t* keys, std::uint32_t met, std::uint32_t count) {
  for (std::uint32_t i = 0; i < met && i + 1 < count; ++i) {
    if (from.format.depthOf(keys[i * from.stride]) == from.format.depthOf(keys[(i + 1) * from.stride])) return true;
  }
  return false;
}

// `to(row)`: where results of a row go.
template <class To>
HWY_INLINE HWY_ATTR std::uint64_t blendRows(const OverBlock& block, const cpu::BlockOrder& order, To to) {
  const Source from(block);
  alignas(32) const double background[4] = {block.background.r, block.background.g, block.background.b, 0};
  std::uint64_t coplanar = 0;
  for (int first = 0; first < cpu::kBlockPixels; first += cpu::kBlockSize) {
    const std::uint64_t* const keys = block.block.keys + first;
    const std::uint32_t* const counts = block.block.counts + first;
    const auto bitsOfRow = [first](std::uint64_t pixels) { return static_cast<std::uint32_t>(pixels >> first) & 0xFF; };
    std::uint32_t left = bitsOfRow(order.certain);
    if (!left) continue;   // the row may lie below the image
    const auto out = to(first / cpu::kBlockSize);
    const std::uint32_t repeats = bitsOfRow(order.repeats);
    std::uint32_t coplanarOfRow = bitsOfRow(order.coplanar);
    for (; left; left &= left - 1) {
      const int x = __builtin_ctz(left);
      if (repeats >> x & 1) {
        out.repeat(x);
        coplanarOfRow = (coplanarOfRow & ~(1u << x)) | (coplanarOfRow >> (x - 1) & 1) << x;
        continue;
      }
      State state;
      for (auto& part : state.color) part = hn::Zero(Channels());
      const std::uint32_t count = counts[x];
      const std::uint32_t met = from.mayEnd ? blendFragments<true>(from, keys + x, count, state) : blendFragments<false>(from, keys + x, count, state);
      if (met < count && coplanarOfRow >> x & 1 && !meetsCoplanar(from, keys + x, met, count)) coplanarOfRow ^= 1u << x;
      out.put(x, Result(state, background));
    }
    coplanar |= std::uint64_t{coplanarOfRow} << first;
  }
  return coplanar;
}

HWY_ATTR std::uint64_t BlendBlock(const OverBlock& from, const cpu::BlockOrder& order, BlendedPixel* out) {
  return blendRows(from, order, [out](int row) { return ToPixels{out + row * cpu::kBlockSize}; });
}

HWY_ATTR std::uint64_t BlendColors(const OverBlock& from, const cpu::BlockOrder& order, Rgb8* first, std::ptrdiff_t rowPixels) {
  return blendRows(from, order, [=](int row) { return ToImage{first + row * rowPixels}; });
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
