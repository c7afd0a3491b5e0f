// Adaptive bucket peeling: see bad.cpp.
#if defined(PASS_RESOLVE)
#include "core/gl/frame.glsl"
#else
#include "core/gl/fragment.glsl"
#endif

layout(std430, binding = COPEEL_BUFFER_METHOD + 4) coherent buffer RangeNear { uint rangeNear[]; };   // nearest and farthest key of a pixel
layout(std430, binding = COPEEL_BUFFER_METHOD + 5) coherent buffer RangeFar { uint rangeFar[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 6) coherent buffer Maps { uint maps[]; };             // occupied intervals of a pixel's range, BAD_WORDS words

#if !defined(PASS_RESOLVE)

// The fragment's interval of the pixel's own range.
uint intervalIn(uint pixel, uint key) {
  uint near = rangeNear[pixel];
  float share = float(key - near) / float(rangeFar[pixel] - near + 1u);
  return min(uint(share * float(BAD_WORDS * 32)), uint(BAD_WORDS * 32 - 1));
}

// Occupied intervals are dealt out to the buckets evenly, front to back.
uint bucketOf(uint pixel, uint key) {
  uint interval = intervalIn(pixel, key), before = 0u, all = 0u;
  for (uint word = 0u; word < uint(BAD_WORDS); ++word) {
    uint bits = maps[pixel * uint(BAD_WORDS) + word];
    all += uint(bitCount(bits));
    if (word < interval / 32u) before += uint(bitCount(bits));
    else if (word == interval / 32u) before += uint(bitCount(bits & ((1u << (interval % 32u)) - 1u)));
  }
  return before * uint(K) / max(all, uint(K));
}
#endif

#if defined(PASS_RANGE)

void main() {
  uint key = fragmentKey(), pixel = pixelIndex();
  atomicMin(rangeNear[pixel], key);
  atomicMax(rangeFar[pixel], key);
}

#elif defined(PASS_OCCUPY)

void main() {
  uint pixel = pixelIndex(), interval = intervalIn(pixel, fragmentKey());
  atomicOr(maps[pixel * uint(BAD_WORDS) + interval / 32u], 1u << (interval % 32u));
}

#else
#include "core/gl/bucket_pairs.glsl"
#endif
