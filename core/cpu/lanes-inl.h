// Included once per SIMD target by others of this kind; no include guard but Highway's.
#if defined(COPEEL_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef COPEEL_LANES_INL_H_
#undef COPEEL_LANES_INL_H_
#else
#define COPEEL_LANES_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <span>

#include <hwy/highway.h>

#include "core/cpu/projection.h"

HWY_BEFORE_NAMESPACE();
namespace copeel::cpu {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Of up to eight lanes, the first the lowest bit.
template <class D>
HWY_INLINE HWY_ATTR std::uint32_t bitsOf(D d, hn::Mask<D> mask) {
  std::uint8_t byte[8] = {};
  hn::StoreMaskBits(d, mask, byte);
  return std::uint32_t{byte[0]} & ((1u << hn::Lanes(d)) - 1);
}

// counts: of some rows of blocks.
HWY_INLINE HWY_ATTR std::uint32_t largestOf(std::span<const std::uint32_t> counts) {
  const hn::CappedTag<std::uint32_t, kBlockSize> d;
  auto largest = hn::LoadU(d, counts.data());
  for (std::size_t i = hn::Lanes(d); i < counts.size(); i += hn::Lanes(d)) largest = hn::Max(largest, hn::LoadU(d, counts.data() + i));
  return hn::GetLane(hn::MaxOfLanes(d, largest));
}

// Of a row of a block: pixels that have fewer fragments.
HWY_INLINE HWY_ATTR std::uint32_t lanesBelow(const std::uint32_t* counts, std::uint32_t n) {
  const hn::CappedTag<std::uint32_t, kBlockSize> d;
  std::uint32_t mask = 0;
  for (std::size_t lane = 0; lane < kBlockSize; lane += hn::Lanes(d)) {
    mask |= bitsOf(d, hn::Lt(hn::LoadU(d, counts + lane), hn::Set(d, n))) << lane;
  }
  return mask;
}

}  // namespace HWY_NAMESPACE
}  // namespace copeel::cpu
HWY_AFTER_NAMESPACE();

#endif
