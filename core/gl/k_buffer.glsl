// The K nearest fragments of a pixel, for invocations that come one at a time (k-plus) or that take the risk (kb). The farthest is at place 0 as soon as
// the buffer is full, so that one look tells whether a fragment is too far (Vasilakis, Fudos 2014). Small buffers are searched for the next farthest,
// with K_HEAP they are max-heaps. Order: key, then the later primitive first, as the fold wants it, so that the K nearest do not depend on the order of drawing.
layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Seen { uint seen[]; };              // fragments that came to the pixel
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer Fragments { uvec2 fragments[]; };   // {key, id}, K of each pixel
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer Kept { uint kept[]; };          // fragments in the buffer; the top bit: it is in use
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer Missed { uint missed, hazards; };

#define K_IN_USE 0x80000000u

#if !defined(PASS_GATHER)

#include "core/gl/fold.glsl"
#define ARRAY fragments
#include "core/gl/sort_array.glsl"

void deliverNearest() {
  uint pixel = pixelIndex(), count = seen[pixel];
#if defined(PASS_RESOLVE)
  if (count > uint(K)) atomicAdd(missed, count - uint(K));
#endif
  deliverArray(pixel * uint(K), kept[pixel] & ~K_IN_USE);
}

#else

#include "core/gl/sort_short.glsl"

// Of a buffer whose place 0 is free for `moving`: moves the farthest there.
void settle(uint first, uint at, uvec2 moving) {
#if defined(K_HEAP)
  for (uint child = 2u * at + 1u; child < uint(K); child = 2u * at + 1u) {
    uvec2 farthest = fragments[first + child];
    if (child + 1u < uint(K)) {
      uvec2 other = fragments[first + child + 1u];
      if (fragmentBefore(farthest, other)) farthest = other, ++child;
    }
    if (!fragmentBefore(moving, farthest)) break;
    fragments[first + at] = farthest;
    at = child;
  }
  fragments[first + at] = moving;
#else
  uint place = 0u;
  uvec2 farthest = moving;
  for (uint i = 1u; i < uint(K); ++i) {
    uvec2 other = fragments[first + i];
    if (fragmentBefore(farthest, other)) farthest = other, place = i;
  }
  if (place > 0u) fragments[first + place] = moving;
  fragments[first] = farthest;
#endif
}

// True when the buffer is full of nearer keys. Without a lock that may be out of date; as the farthest key only ever comes nearer once the buffer is full, it
// then errs by letting the fragment through. Ids are left out, as they could be another record's than the key.
bool tooFar(uint pixel, uvec2 fragment) {
  if ((kept[pixel] & ~K_IN_USE) != uint(K)) return false;
  memoryBarrierBuffer();   // who wrote that count wrote the farthest before
  return fragments[pixel * uint(K)].x < fragment.x;
}

// Returns the new count.
uint keepNearest(uint first, uint count, uvec2 fragment) {
  if (count < uint(K)) {
    fragments[first + count] = fragment;
    if (count + 1u < uint(K)) return count + 1u;
#if defined(K_HEAP)
    for (uint node = uint(K) / 2u; node-- > 0u;) settle(first, node, fragments[first + node]);
#else
    settle(first, 0u, fragments[first]);
#endif
  } else if (fragmentBefore(fragment, fragments[first])) {
    settle(first, 0u, fragment);
  }
  return uint(K);
}

#endif
