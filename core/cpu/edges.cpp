// Dispatch; the code is in edges-inl.h, compiled once per target.
#include "core/cpu/edges.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/cpu/edges-inl.h"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/cpu/edges-inl.h"

namespace copeel::cpu {

HWY_EXPORT(SetUpEdges);

void setUpEdges(EdgeBatch& batch, int count, const TileFrame& tile) { HWY_DYNAMIC_DISPATCH(SetUpEdges)(batch, count, tile); }

}  // namespace copeel::cpu
