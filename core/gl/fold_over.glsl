// Transparency on the device: core/fold/over.glsl behind the interface of core/gl/fold.glsl. Within a group the later primitive lies in front.
//
// Result words: colour (three doubles, premultiplied), transmittance (a double), id + 1 of the nearest primitive that is seen (0: none), fragments,
// fragments of the largest group, 0: three texels (FOLD_WORDS is uvec4). Where there are none, the colour may be anything. The background comes later.
#include "core/fold/common_glsl.h"
#include "core/fold/over.glsl"

// As texels, as in fragment.glsl.
layout(binding = COPEEL_TEXTURE_PRIMITIVES) uniform usamplerBuffer overPrimitives;          // plane class, object
layout(binding = COPEEL_TEXTURE_FOLD_TABLE) uniform samplerBuffer overBases;
layout(binding = COPEEL_TEXTURE_FOLD_TABLE + 1) uniform usamplerBuffer overRanges;          // per object: base = x + y · primitive
layout(binding = COPEEL_TEXTURE_FOLD_TABLE + 2) uniform samplerBuffer overShades;           // per plane class

#define OVER_STATE_TEXELS 6u

uint overSide;
OverState overMain, overRest;    // the side so far; of the open group what came from its other end
uint overNearest, overGroupFront, overGroupBehind;   // primitives that are seen, + 1
uint overLayers, overLargest, overOpen;

void overPut(uint at, OverState state) {
  foldStates[at] = uvec4(unpackDouble2x32(state.color.x), unpackDouble2x32(state.color.y));
  foldStates[at + 1u] = uvec4(unpackDouble2x32(state.color.z), unpackDouble2x32(state.transmittance));
}

OverState overTake(uint at) {
  uvec4 first = foldStates[at], second = foldStates[at + 1u];
  return OverState(dvec3(packDouble2x32(first.xy), packDouble2x32(first.zw), packDouble2x32(second.xy)), packDouble2x32(second.zw));
}

void foldStore(uint side) {
  uint at = foldStateAt(side, OVER_STATE_TEXELS);
  overPut(at, overMain);
  overPut(at + 2u, overRest);
  foldStates[at + 4u] = uvec4(overNearest, overGroupFront, overGroupBehind, overLayers);
  foldStates[at + 5u] = uvec4(overLargest, overOpen, 0u, 0u);
}

void foldLoad(uint side) {
  uint at = foldStateAt(side, OVER_STATE_TEXELS);
  uvec4 seen = foldStates[at + 4u], counts = foldStates[at + 5u];
  overSide = side;
  overMain = overTake(at);
  overRest = overTake(at + 2u);
  overNearest = seen.x, overGroupFront = seen.y, overGroupBehind = seen.z, overLayers = seen.w;
  overLargest = counts.x, overOpen = counts.y;
}

void foldReset(uint side) {
  overSide = side;
  overBegin(overMain);
  overBegin(overRest);
  overNearest = overGroupFront = overGroupBehind = overLayers = overLargest = overOpen = 0u;
}

void foldInitial(uint side) {
  foldReset(side);
  foldStore(side);
}

vec4 overColorOf(uint primitive) {
  uvec2 found = texelFetch(overPrimitives, int(primitive)).xy, range = texelFetch(overRanges, int(found.y)).xy;
  return overShade(texelFetch(overBases, int(range.x + range.y * primitive)), texelFetch(overShades, int(found.x)).x);
}

void foldFront(uint id) {
  uint primitive = id & COPEEL_ID_PRIMITIVE;
  vec4 color = overColorOf(primitive);
  if (overSide == COPEEL_FRONT) overFragment(overMain, color);
  else overFragment(overRest, color);
  if (overGroupFront == 0u && color.a > 0.0) overGroupFront = primitive + 1u;
  ++overOpen;
}

void foldBehind(uint id) {
  uint primitive = id & COPEEL_ID_PRIMITIVE;
  vec4 color = overColorOf(primitive);
  if (overSide == COPEEL_FRONT) overBehind(overRest, color);
  else overBehind(overMain, color);
  if (color.a > 0.0) overGroupBehind = primitive + 1u;
  ++overOpen;
}

bool foldCloseGroup(uint key) {
#ifndef FOLD_WHOLE   // which takes a group from its front end alone
  if (overSide == COPEEL_FRONT) overMain = overJoin(overMain, overRest);
  else overMain = overJoin(overRest, overMain);
  overBegin(overRest);
#endif
  uint nearest = overGroupFront != 0u ? overGroupFront : overGroupBehind;
  if (nearest != 0u && (overSide == COPEEL_BACK || overNearest == 0u)) overNearest = nearest;
  overGroupFront = overGroupBehind = 0u;
  overLayers += overOpen;
  overLargest = max(overLargest, overOpen);
  overOpen = 0u;
  return overSide == COPEEL_FRONT && overEnough(overMain) && FOLD_MAY_END != 0;
}

void overWrite(OverState whole, uint nearest, uint layers, uint largest) {
  uint at = pixelIndex() * 3u;
  foldResults[at] = uvec4(unpackDouble2x32(whole.color.x), unpackDouble2x32(whole.color.y));
  foldResults[at + 1u] = uvec4(unpackDouble2x32(whole.color.z), unpackDouble2x32(whole.transmittance));
  foldResults[at + 2u] = uvec4(nearest, layers, largest, 0u);
}

void foldNothing() { foldResults[pixelIndex() * 3u + 2u] = uvec4(0u); }

void foldFinishFront() { overWrite(overMain, overNearest, overLayers, overLargest); }

void foldFinish() {
  foldLoad(COPEEL_BACK);
  OverState back = overMain;
  uint nearest = overNearest, layers = overLayers, largest = overLargest;
  foldLoad(COPEEL_FRONT);
  overWrite(overJoin(overMain, back), overNearest != 0u ? overNearest : nearest, overLayers + layers, max(overLargest, largest));
}
