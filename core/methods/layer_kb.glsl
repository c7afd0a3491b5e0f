// Peeling layer by layer into k-buffers: see layer_kb.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif
#include "core/gl/layers.glsl"
#include "core/gl/ordered_id.glsl"

layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer Slots { uint slots[]; };   // per pixel and side, k ids as orders; ORDER_BELOW: free
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer Overflow { uint overflow; };

uniform uint k;

#if defined(PASS_GATHER)

void main() {
  uint side;
  if (!layerOf(fragmentKey(), side)) return;
  uint first = (pixelIndex() * LAYER_SIDES + side) * k, order = orderOfId(fragmentId());
  for (uint i = first; i < first + k; ++i) {
#ifdef SORTED
    order = min(order, atomicMax(slots[i], order));
    if (order == ORDER_BELOW) return;
#else
    if (slots[i] == ORDER_BELOW && atomicCompSwap(slots[i], ORDER_BELOW, order) == ORDER_BELOW) return;
#endif
  }
  atomicAdd(overflow, 1u);
}

#elif defined(PASS_RESOLVE)

#include "core/gl/sort_slots.glsl"

bool resolveSide(uint side, uint key) {
  uint first = (pixelIndex() * LAYER_SIDES + side) * k, count = 0u;
  while (count < k && slots[first + count] != ORDER_BELOW) ++count;
#ifndef SORTED
  sortSlots(first, count);
#endif
  foldLoad(side);
  for (uint i = first; i < first + count; ++i) {
    foldFront(idOfOrder(slots[i]));
    slots[i] = ORDER_BELOW;
  }
  bool enough = foldCloseGroup(key);
  foldStore(side);
  layerClose(side, key);
  return enough;
}

#include "core/gl/resolve_layers.glsl"

#endif
