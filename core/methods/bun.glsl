// Uniform bucket peeling: see bun.cpp.
#if defined(PASS_RESOLVE)
#include "core/gl/frame.glsl"
#else
#include "core/gl/fragment.glsl"
#include "core/gl/intervals.glsl"

uint bucketOf(uint pixel, uint key) { return intervalOf(key, uint(K)); }
#endif
#include "core/gl/bucket_pairs.glsl"
