// k-buffer: see kb.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#include "core/gl/occupancy.glsl"
#else
#include "core/gl/frame.glsl"
#endif
#include "core/gl/k_buffer.glsl"

#if defined(PASS_GATHER)

// The mark "in use" keeps nobody out; it only tells that two fragments met.
void main() {
  uvec2 fragment = uvec2(fragmentKey(), fragmentId());
  if (gl_HelperInvocation || beyondOccupancy(fragment.x)) return;
  uint pixel = pixelIndex();
  atomicAdd(seen[pixel], 1u);
  uint count = atomicOr(kept[pixel], K_IN_USE);
  if ((count & K_IN_USE) != 0u) atomicAdd(hazards, 1u);
  count = keepNearest(pixel * uint(K), count & ~K_IN_USE, fragment);
  memoryBarrierBuffer();
  atomicExchange(kept[pixel], count);
}

#else

void main() { deliverNearest(); }

#endif
