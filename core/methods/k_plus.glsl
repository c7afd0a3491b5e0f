// k⁺-buffer: see k_plus.cpp.
#if defined(K_INTERLOCK) && defined(PASS_GATHER)
#extension GL_ARB_fragment_shader_interlock : require
layout(pixel_interlock_unordered) in;
#endif
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#include "core/gl/occupancy.glsl"
#else
#include "core/gl/frame.glsl"
#endif
#include "core/gl/k_buffer.glsl"

#if defined(PASS_GATHER) && defined(K_INTERLOCK)

void main() {
  uvec2 fragment = uvec2(fragmentKey(), fragmentId());
  uint pixel = pixelIndex(), first = pixel * uint(K);
  bool wanted = !gl_HelperInvocation && !beyondOccupancy(fragment.x);
  if (wanted) atomicAdd(seen[pixel], 1u);
  wanted = wanted && !tooFar(pixel, fragment);
  beginInvocationInterlockARB();
  if (wanted) {
    uint count = keepNearest(first, kept[pixel], fragment);
    memoryBarrierBuffer();   // the count says what lies at place 0
    kept[pixel] = count;
  }
  endInvocationInterlockARB();
}

#elif defined(PASS_GATHER)

// A lock is taken and given back within one turn of the loop: lanes that run in lock step and want the same pixel then pass one after another, none waits for
// a lane that stands still. Helper invocations own no pixel and must not wait: what an atomic tells them is undefined.
void main() {
  uvec2 fragment = uvec2(fragmentKey(), fragmentId());
  if (gl_HelperInvocation || beyondOccupancy(fragment.x)) return;
  uint pixel = pixelIndex(), first = pixel * uint(K);
  atomicAdd(seen[pixel], 1u);
  bool done = tooFar(pixel, fragment);
  while (!done) {
    uint count = atomicOr(kept[pixel], K_IN_USE);
    if ((count & K_IN_USE) == 0u) {
      memoryBarrierBuffer();
      count = keepNearest(first, count, fragment);
      memoryBarrierBuffer();
      atomicExchange(kept[pixel], count);
      done = true;
    }
  }
}

#else

void main() { deliverNearest(); }

#endif
