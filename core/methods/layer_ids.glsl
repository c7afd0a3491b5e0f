// Peeling coplanar fragments by their ids: see layer_ids.cpp.
#if defined(PASS_SELECT) || defined(PASS_SHADE)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif
#include "core/gl/layers.glsl"
#include "core/gl/ordered_id.glsl"

// Of the fragments of a layer, those between `above` and `below` are left; of these the least, the greatest and their number. Ids as orders.
struct IdRange {
  uint above, below, least, greatest, count;
};
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer IdRanges { IdRange ids[]; };   // per pixel and side
#ifdef SHADED
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) buffer ShadedIds { uvec2 shaded[]; };          // whole ids of the greatest and the least
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) buffer Leaving { uint anyLeaves; };
#endif

IdRange idsBetween(uint above, uint below) { return IdRange(above, below, ORDER_ABOVE, ORDER_BELOW, 0u); }

uint rangeAt(uint side) { return pixelIndex() * LAYER_SIDES + side; }

#if defined(PASS_SELECT)

void main() {
  uint side;
  if (!layerOf(fragmentKey(), side)) return;
#ifdef SHADED
  uint order = orderOfId(fragmentPrimitive());
#else
  uint order = orderOfId(fragmentId());
#endif
  uint at = rangeAt(side);
  if (order <= ids[at].above || order >= ids[at].below) return;
  if (order < ids[at].least) atomicMin(ids[at].least, order);
  if (order > ids[at].greatest) atomicMax(ids[at].greatest, order);
  atomicAdd(ids[at].count, 1u);
}

#elif defined(PASS_SHADE)

void main() {
  uint i = pixelIndex();
  if (fragmentKey() != layerKey(COPEEL_FRONT)) return;
  uint order = orderOfId(fragmentPrimitive());
  if (order == ids[i].greatest) shaded[i].x = fragmentId();
  if (order == ids[i].least) shaded[i].y = fragmentId();
}

#elif defined(PASS_BEGIN)

void main() {
  for (uint side = 0u; side < LAYER_SIDES; ++side) ids[rangeAt(side)] = idsBetween(ORDER_BELOW, ORDER_ABOVE);
}

#elif defined(PASS_RESOLVE)

void deliver(IdRange range) {
#ifdef SHADED
  uvec2 found = shaded[pixelIndex()];
#else
  uvec2 found = uvec2(idOfOrder(range.greatest), idOfOrder(range.least));
#endif
  foldFront(found.x);
  if (FRAGMENTS_AT_ONCE == 2 && range.count > 1u) foldBehind(found.y);
}

// Delivers what was found of a layer, and goes on to the next when nothing else is in it; true: the pixel has enough.
bool resolveSide(uint side, uint key) {
  IdRange range = ids[rangeAt(side)];
  foldLoad(side);
  deliver(range);
  bool complete = range.count <= uint(FRAGMENTS_AT_ONCE);
  bool enough = complete && foldCloseGroup(key);
  foldStore(side);
  if (complete) {
    layerClose(side, key);
    ids[rangeAt(side)] = idsBetween(ORDER_BELOW, ORDER_ABOVE);
#ifdef SHADED
    anyLeaves = 1u;
#endif
  } else {
    layerKeep(side, key);
    ids[rangeAt(side)] = idsBetween(FRAGMENTS_AT_ONCE == 2 ? range.least : ORDER_BELOW, range.greatest);
  }
  return enough;
}

#include "core/gl/resolve_layers.glsl"

#endif
