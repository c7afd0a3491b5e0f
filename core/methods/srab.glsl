// Stencil-routed A-buffer: see srab.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#include "core/gl/occupancy.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif

layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Arrived { uint arrived[]; };   // fragments that came to the pixel
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) buffer Fragments { uvec2 fragments[]; };   // {key, id}, K of each pixel
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer Missed { uint missed; };

#if defined(PASS_GATHER)

void main() {
  uint key = fragmentKey();
  if (beyondOccupancy(key)) return;
  uint pixel = pixelIndex();
  uint arrival = atomicAdd(arrived[pixel], 1u);
  if (arrival < uint(K)) fragments[pixel * uint(K) + arrival] = uvec2(key, fragmentId());
}

#else

#define ARRAY fragments
#include "core/gl/sort_array.glsl"

void main() {
  uint pixel = pixelIndex(), count = arrived[pixel];
#if defined(PASS_RESOLVE)
  if (count > uint(K)) atomicAdd(missed, count - uint(K));
#endif
  deliverArray(pixel * uint(K), min(count, uint(K)));
}

#endif
