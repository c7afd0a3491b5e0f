// Dispatch; the code is in block_order-inl.h, compiled once per target.
#include "core/cpu/block_order.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "core/cpu/tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/cpu/block_order-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/cpu/block_order-inl.h"

namespace copeel::cpu {

HWY_EXPORT(SortBlock);
HWY_EXPORT(SameStacks);

void sortBlock(const FragmentBlock& block) { HWY_DYNAMIC_DISPATCH(SortBlock)(block); }

bool sameStacks(const FragmentBlock& block, const Tile& tile) { return HWY_DYNAMIC_DISPATCH(SameStacks)(block, tile); }

}  // namespace copeel::cpu
