// Peeling that goes on within a layer only where it holds several fragments: see hybrid.cpp.
#if defined(PASS_PEEL)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif
#include "core/gl/layers.glsl"
#include "core/gl/ordered_id.glsl"

// `above` 0: the pixel looks for its next layer; else it is within one, of which the orders between `above` and `below` are left.
// `mark`: 2 key + 1 of the nearest fragment met, 2 key once a second one was met there; within a layer the number of fragments met.
struct Within {
  uint above, below, greatest, mark;
};
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer Withins { Within within[]; };

const uint NO_MARK = 2u * COPEEL_KEY_NONE + 1u;

#if defined(PASS_PEEL)

layout(location = 0) out uint id;

// Of the fragments at the nearest depth all but the first meet its mark, whatever comes between. A mark read too early is too far, never too near.
bool markNearest(uint i, uint key) {
  uint mark = within[i].mark;
  if (key > mark >> 1) return false;
  if (mark == 2u * key) return true;
  if (atomicMin(within[i].mark, 2u * key + 1u) >> 1 == key) atomicMin(within[i].mark, 2u * key);
  return true;
}

bool markWithin(uint i, uint key) {
  uint order = orderOfId(fragmentId());
  if (key != layers[i] || order <= within[i].above || order >= within[i].below) return false;
  if (order > within[i].greatest) atomicMax(within[i].greatest, order);
  atomicAdd(within[i].mark, 1u);
  return true;
}

void main() {
  uint key = fragmentKey(), i = pixelIndex();
  if (!layerAdmits(key, key)) discard;
  if (within[i].above == ORDER_BELOW ? !markNearest(i, key) : !markWithin(i, key)) discard;
  gl_FragDepth = uintBitsToFloat(key);
  id = fragmentId();
}

#elif defined(PASS_BEGIN)

void main() { within[pixelIndex()] = Within(ORDER_BELOW, ORDER_ABOVE, ORDER_BELOW, NO_MARK); }

#elif defined(PASS_RESOLVE)

layout(binding = 0) uniform usampler2D ids;

// Delivers what was found; true: nothing else is in the layer.
bool deliver(Within found, uint key, uint least) {
  if (found.above == ORDER_BELOW) {
    bool alone = found.mark == 2u * key + 1u;
    if (alone) foldFront(least);
    else foldBehind(least);
    return alone;
  }
  foldFront(idOfOrder(found.greatest));
  if (found.mark > 1u) foldBehind(least);
  return found.mark <= 2u;
}

bool resolveSide(uint side, uint key) {
  uint i = pixelIndex();
  Within found = within[i];
  uint least = texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r;
  foldLoad(side);
  bool complete = deliver(found, key, least);
  bool enough = complete && foldCloseGroup(key);
  foldStore(side);
  if (complete) {
    layerClose(side, key);
    within[i] = Within(ORDER_BELOW, ORDER_ABOVE, ORDER_BELOW, NO_MARK);
  } else {
    layerKeep(side, key);
    within[i] = Within(orderOfId(least), found.above == ORDER_BELOW ? ORDER_ABOVE : found.greatest, ORDER_BELOW, 0u);
  }
  return enough;
}

#include "core/gl/resolve_layers.glsl"

#endif
