// S-buffer: see sb.cpp.
#if defined(PASS_COUNT) || defined(PASS_FILL)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif

layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Counts { uint counts[]; };      // fragments of a pixel
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer Places { uint places[]; };  // of a pixel's next fragment, within its group
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer Groups { uint groupCounts[SB_GROUPS], groupFirst[SB_GROUPS], total; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) buffer Fragments { uvec2 fragments[]; };    // {key, id}

uniform uint capacity;   // fragments

uint hashOf(uint pixel) { return pixel % uint(SB_GROUPS); }   // H(P), 2012

#if defined(PASS_COUNT)

void main() {
  discardNoFragment();
  atomicAdd(counts[pixelIndex()], 1u);
}

#elif defined(PASS_PLACE)

void main() {
  uint pixel = pixelIndex(), count = counts[pixel];
  if (count > 0u) places[pixel] = atomicAdd(groupCounts[hashOf(pixel)], count);
}

#elif defined(PASS_PREFIX)

// One invocation (sb.cpp draws one pixel): the groups are few.
void main() {
  uint sum = 0u;
  for (uint group = 0u; group < uint(SB_GROUPS); ++group) {
    groupFirst[group] = sum;
    sum += groupCounts[group];
  }
  total = sum;
}

#elif defined(PASS_FILL)

void main() {
  uint key = fragmentKey(), pixel = pixelIndex();
  uint place = groupFirst[hashOf(pixel)] + atomicAdd(places[pixel], 1u);
  if (place < capacity) fragments[place] = uvec2(key, fragmentId());
}

#else

#define ARRAY fragments
#include "core/gl/sort_array.glsl"

// After FILL a pixel's place is that behind its last fragment.
void main() {
  uint pixel = pixelIndex(), count = counts[pixel];
  if (count == 0u) return;
  uint first = groupFirst[hashOf(pixel)] + places[pixel] - count;
  if (first < capacity) deliverArray(first, min(count, capacity - first));
}

#endif
