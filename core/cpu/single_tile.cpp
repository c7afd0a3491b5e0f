// Dispatch; the code is in single_tile-inl.h, compiled once per target.
#include "core/cpu/single_tile.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/cpu/single_tile-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/cpu/single_tile-inl.h"

namespace copeel::cpu {

HWY_EXPORT(FindSingleTiles);

void findSingleTiles(CornerBatch& batch, std::size_t count, const TileGrid& grid) { HWY_DYNAMIC_DISPATCH(FindSingleTiles)(batch, count, grid); }

}  // namespace copeel::cpu
