// A-buffer in per-pixel linked lists: see ll.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#include "core/gl/occupancy.glsl"
#else
#include "core/gl/frame.glsl"
#endif
#include "core/gl/lists.glsl"

#if defined(PASS_GATHER)

void main() {
  uint key = fragmentKey();
  if (!beyondOccupancy(key)) gatherIntoList(0u, key);
}

#endif
