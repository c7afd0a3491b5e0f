// Multi-layer depth peeling via fragment sort: see multi_kb.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif

layout(std430, binding = COPEEL_BUFFER_METHOD) buffer Peeled { uint peeled[]; };                      // key of the last layer that was delivered
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer Buckets { uvec2 buckets[]; };      // {key, id}, K of each pixel; key COPEEL_KEY_NONE: free

#if defined(PASS_GATHER)

// The occlusion query counts what changed the buffer.
void main() {
  uint key = fragmentKey(), pixel = pixelIndex(), first = pixel * uint(K);
  if (key <= peeled[pixel]) discard;
  uint farthest = 0u, place = 0u;
  for (uint i = 0u; i < uint(K); ++i) {
    uint other = buckets[first + i].x;
    if (other == key) discard;
    if (other > farthest) farthest = other, place = i;
  }
  if (key >= farthest) discard;
  buckets[first + place] = uvec2(key, fragmentId());
}

#else

#define SORT_SHORT (K > 5 ? K : 5)
#define SORT_DISTINCT   // two fragments of one depth, written at once, are a hazard that the equality test could not see
#include "core/gl/sort_short.glsl"

void main() {
  uint pixel = pixelIndex(), first = pixel * uint(K), farthest = 0u;
  if (peeled[pixel] == COPEEL_KEY_DONE) return;
  beginShort();
  for (uint i = 0u; i < uint(K); ++i) {
    uvec2 fragment = buckets[first + i];
    if (fragment.x == COPEEL_KEY_NONE) continue;
    putShort(fragment);
    farthest = max(farthest, fragment.x);
    buckets[first + i] = uvec2(COPEEL_KEY_NONE);
  }
  foldLoad(COPEEL_FRONT);
  bool enough = deliverShort() || shortCount < uint(K);
  foldStore(COPEEL_FRONT);
  peeled[pixel] = enough ? COPEEL_KEY_DONE : farthest;
}

#endif
