// Occupancy maps: see occupancy.cpp.
#if defined(PASS_FILL)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#endif
#include "core/gl/occupancy.glsl"

layout(std430, binding = COPEEL_BUFFER_METHOD + 5) coherent buffer Maps { uint maps[]; };   // OCCUPANCY bits of each pixel

#if defined(PASS_FILL)

void main() {
  uint interval = intervalOf(fragmentKey(), uint(OCCUPANCY));
  atomicOr(maps[pixelIndex() * (uint(OCCUPANCY) / 32u) + interval / 32u], 1u << (interval % 32u));
}

#else

// The k-th bit is at most the k-th fragment's, so nothing of the k nearest lies behind its interval (Lemma 2.1).
void main() {
  uint first = pixelIndex() * (uint(OCCUPANCY) / 32u), before = 0u;
  limits[pixelIndex()] = uint(OCCUPANCY);
  for (uint word = 0u; word < uint(OCCUPANCY) / 32u; ++word) {
    uint bits = maps[first + word], count = uint(bitCount(bits));
    if (before + count < uint(OCCUPANCY_K)) {
      before += count;
      continue;
    }
    // Kernighan: each turn takes the lowest bit away.
    for (; before + 1u < uint(OCCUPANCY_K); ++before) bits &= bits - 1u;
    limits[pixelIndex()] = word * 32u + uint(findLSB(bits));
    return;
  }
}

#endif
