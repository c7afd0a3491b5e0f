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

// overResult and overLevels.
HWY_INLINE HWY_ATTR void finishPixel(const State& state, const double* background, BlendedPixel& out) {
  const Channels d;
  for (std::size_t part = 0; part < kParts; ++part) {
    const std::size_t lane = part * hn::MaxLanes(d);
    const auto color = hn::Add(state.color[part], hn::Mul(hn::Load(d, background + lane), hn::Set(d, state.transmittance)));
    hn::StoreU(hn::DemoteTo(Floats(), color), Floats(), out.color + lane);
    const auto clamped = hn::Min(hn::Max(color, hn::Zero(d)), hn::Set(d, 255.0));
    const auto levels = hn::DemoteTo(Ints(), hn::Add(clamped, hn::Set(d, 0.5 + 1.0 / 8589934592.0)));
    hn::StoreU(hn::DemoteTo(Bytes(), levels), Bytes(), out.bytes + lane);
  }
}

template <bool kMayEnd>
HWY_INLINE HWY_ATTR void blendDistinct(const OverBlock& from, int pixel, State& state) {
  const std::uint64_t* key = from.block.keys + pixel;
  for (std::uint32_t left = from.block.counts[pixel]; left > 0; --left, key += from.block.stride) {
    blendFragment(state, from.colors[from.format.slotOf(*key)]);
    if (kMayEnd && state.transmittance == 0.0) return;
  }
}

// Runs of equal depth are met from the last slot to the first. True: some had more than one fragment.
HWY_INLINE HWY_ATTR bool blendRuns(const OverBlock& from, int pixel, State& state) {
  const auto key = [&](std::uint32_t i) HWY_ATTR { return from.block.layer(i)[pixel]; };
  const std::uint32_t count = from.block.counts[pixel];
  bool coplanar = false;
  for (std::uint32_t begin = 0; begin < count;) {
    const std::uint64_t depth = from.format.depthOf(key(begin));
    std::uint32_t end = begin + 1;
    while (end < count && from.format.depthOf(key(end)) == depth) ++end;
    coplanar |= end - begin > 1;
    for (std::uint32_t i = end; i-- > begin;) blendFragment(state, from.colors[from.format.slotOf(key(i))]);
    if (from.mayEnd && state.transmittance == 0.0) break;
    begin = end;
  }
  return coplanar;
}

HWY_ATTR std::uint64_t BlendBlock(const OverBlock& fromBlock, const cpu::BlockOrder& orderOfBlock, BlendedPixel* out) {
  const OverBlock from = fromBlock;
  const cpu::BlockOrder order = orderOfBlock;
  alignas(32) const double background[4] = {from.background.r, from.background.g, from.background.b, 0};
  std::uint64_t coplanar = 0;
  for (std::uint64_t left = order.certain; left; left &= left - 1) {
    const int p = __builtin_ctzll(left);
    if (order.repeats >> p & 1) {
      out[p] = out[p - 1];
      coplanar |= (coplanar >> (p - 1) & 1) << p;
      continue;
    }
    State state;
    for (auto& part : state.color) part = hn::Zero(Channels());
    if (order.coplanar >> p & 1) coplanar |= std::uint64_t{blendRuns(from, p, state)} << p;
    else if (from.mayEnd) blendDistinct<true>(from, p, state);
    else blendDistinct<false>(from, p, state);
    finishPixel(state, background, out[p]);
  }
  return coplanar;
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::fold
HWY_AFTER_NAMESPACE();

#endif
