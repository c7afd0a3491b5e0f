// Transparency on the device: core/fold/over.glsl behind the interface of core/gl/fold.glsl. Within a group the later primitive lies in front.
//
// Result words: colour (three doubles, premultiplied), transmittance (a double), id + 1 of the nearest primitive that is seen (0: none), fragments,
// fragments of the largest group, 0: three texels (the define FOLD_RESULT is uvec4). Where there are none, the colour may be anything. The background comes later.
#include "core/fold/common_glsl.h"
#include "core/fold/over.glsl"

// As texels, as in fragment.glsl.
layout(binding = COPEEL_TEXTURE_PRIMITIVES) uniform usamplerBuffer overPrimitives;          // plane class, object
layout(binding = COPEEL_TEXTURE_FOLD_TABLE) uniform samplerBuffer overBases;
layout(binding = COPEEL_TEXTURE_FOLD_TABLE + 1) uniform usamplerBuffer overRanges;          // per object: base = x + y · primitive
layout(binding = COPEEL_TEXTURE_FOLD_TABLE + 2) uniform samplerBuffer overShades;           // per plane class

#define OVER_STATE_WORDS 22u

uint overSide;
OverState overMain, overRest;    // the side so far; of the open group what came from its other end
uint overNearest, overGroupFront, overGroupBehind;   // primitives that are seen, + 1
uint overLayers, overLargest, overOpen;

void overPut(uint at, OverState state) {
  for (uint i = 0u; i < 4u; ++i) {
    uvec2 bits = unpackDouble2x32(i < 3u ? state.color[i] : state.transmittance);
    foldStates[at + 2u * i] = bits.x;
    foldStates[at + 2u * i + 1u] = bits.y;
  }
}

double overDouble(uint at) { return packDouble2x32(uvec2(foldStates[at], foldStates[at + 1u])); }

OverState overTake(uint at) {
  OverState state;
  state.color = dvec3(overDouble(at), overDouble(at + 2u), overDouble(at + 4u));
  state.transmittance = overDouble(at + 6u);
  return state;
}

void foldStore(uint side) {
  uint at = foldStateAt(side, OVER_STATE_WORDS);
  overPut(at, overMain);
  overPut(at + 8u, overRest);
  foldStates[at + 16u] = overNearest;
  foldStates[at + 17u] = overGroupFront;
  foldStates[at + 18u] = overGroupBehind;
  foldStates[at + 19u] = overLayers;
  foldStates[at + 20u] = overLargest;
  foldStates[at + 21u] = overOpen;
}

void foldLoad(uint side) {
  uint at = foldStateAt(side, OVER_STATE_WORDS);
  overSide = side;
  overMain = overTake(at);
  overRest = overTake(at + 8u);
  overNearest = foldStates[at + 16u];
  overGroupFront = foldStates[at + 17u];
  overGroupBehind = foldStates[at + 18u];
  overLayers = foldStates[at + 19u];
  overLargest = foldStates[at + 20u];
  overOpen = foldStates[at + 21u];
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
