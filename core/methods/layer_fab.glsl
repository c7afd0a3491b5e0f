// Peeling layer by layer into fixed-size arrays: see layer_fab.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif
#include "core/gl/layers.glsl"
#include "core/gl/ordered_id.glsl"

layout(std430, binding = COPEEL_BUFFER_METHOD + 1) buffer Slots { uint slots[]; };                    // per pixel and side, k ids as orders
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer SlotCounts { uint slotCounts[]; };   // per pixel and side
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer Overflow { uint overflow; };

uniform uint k;

#if defined(PASS_GATHER)

void main() {
  uint side;
  if (!layerOf(fragmentKey(), side)) return;
  uint array = pixelIndex() * LAYER_SIDES + side;
  uint slot = atomicAdd(slotCounts[array], 1u);
  if (slot < k) slots[array * k + slot] = orderOfId(fragmentId());
}

#elif defined(PASS_RESOLVE)

#include "core/gl/sort_slots.glsl"

bool resolveSide(uint side, uint key) {
  uint array = pixelIndex() * LAYER_SIDES + side, count = min(slotCounts[array], k);
  if (slotCounts[array] > k) atomicAdd(overflow, slotCounts[array] - k);
  sortSlots(array * k, count);
  foldLoad(side);
  for (uint i = 0u; i < count; ++i) foldFront(idOfOrder(slots[array * k + i]));
  bool enough = foldCloseGroup(key);
  foldStore(side);
  slotCounts[array] = 0u;
  layerClose(side, key);
  return enough;
}

#include "core/gl/resolve_layers.glsl"

#endif
