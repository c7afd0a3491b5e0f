// Bucket peeling with linked lists: see bun_ll.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#include "core/gl/intervals.glsl"
#else
#include "core/gl/frame.glsl"
#endif
#include "core/gl/lists.glsl"

#if defined(PASS_GATHER)

void main() {
  uint key = fragmentKey();
  gatherIntoList(intervalOf(key, uint(LISTS)), key);
}

#endif
