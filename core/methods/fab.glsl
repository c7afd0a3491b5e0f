// A-buffer in fixed-size arrays: see fab.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif

layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Counts { uint counts[]; };       // fragments of a pixel, taken or not
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) buffer Fragments { uvec2 fragments[]; };     // {key, id}, `capacity` of each pixel
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer Overflow { uint overflow, wanted; };

uniform uint capacity;

#if defined(PASS_GATHER)

void main() {
  uint key = fragmentKey(), pixel = pixelIndex();
  uint slot = atomicAdd(counts[pixel], 1u);
  if (slot < capacity) {
    fragments[pixel * capacity + slot] = uvec2(key, fragmentId());
  } else {
    atomicAdd(overflow, 1u);
    atomicMax(wanted, slot + 1u);
  }
}

#else

#define ARRAY fragments
#include "core/gl/sort_array.glsl"

void main() {
  uint pixel = pixelIndex();
  uint count = min(counts[pixel], capacity);
  if (count > 0u) deliverArray(pixel * capacity, count);
}

#endif
