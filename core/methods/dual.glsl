// Dual depth peeling: see dual.cpp. What is left lies in [from, to] of layers.glsl, whose ends are the layers that this pass takes.
#ifndef DUAL
#define DUAL 1
#endif
#if defined(PASS_PEEL)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif
#include "core/gl/layers.glsl"
#include "core/gl/ordered_id.glsl"

layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer Ids { uint ids[]; };   // per pixel and side, as orders

#if defined(PASS_PEEL)

// Only what lies between the ends passes: then there is something to take in the next pass.
void main() {
  uint key = fragmentKey(), i = pixelIndex();
  uint from = layers[i].from, to = layers[i].to;
  if (key <= from || key >= to) {
    if (key == from) atomicMax(ids[2u * i + COPEEL_FRONT], orderOfId(fragmentId()));
    else if (key == to) atomicMax(ids[2u * i + COPEEL_BACK], orderOfId(fragmentId()));
    discard;
  }
  if (key < layers[i].nearest) atomicMin(layers[i].nearest, key);
  if (key > layers[i].farthest) atomicMax(layers[i].farthest, key);
}

#elif defined(PASS_RESOLVE)

bool resolveSide(uint side, uint key) {
  uint at = 2u * pixelIndex() + side;
  if (ids[at] == ORDER_BELOW) return false;
  foldLoad(side);
  foldFront(idOfOrder(ids[at]));
  bool enough = foldCloseGroup(key);
  foldStore(side);
  ids[at] = ORDER_BELOW;
  return enough;
}

void main() {
  LayerRange range = layers[pixelIndex()];
  bool enough = resolveSide(COPEEL_FRONT, range.from) || resolveSide(COPEEL_BACK, range.to);
  if (enough || range.nearest > range.farthest) layerEnd();
  else layers[pixelIndex()] = LayerRange(range.nearest, range.farthest, COPEEL_KEY_NONE, 0u);
}

#endif
