// The nearest and the farthest fragment of each of K buckets a pixel. The file that includes this defines bucketOf(pixel, key), monotonic in the key, and the
// passes KEYS (depths), IDS (who has them) and RESOLVE are here. Of coplanar fragments the later primitive stays.
layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer NearKeys { uint nearKeys[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer FarKeys { uint farKeys[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer NearIds { uint nearIds[]; };   // ids with the side bit last, so that they order by primitive
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer FarIds { uint farIds[]; };

#if defined(PASS_KEYS)

void main() {
  uint key = fragmentKey(), pixel = pixelIndex();
  uint bucket = pixel * uint(K) + bucketOf(pixel, key);
  atomicMin(nearKeys[bucket], key);
  atomicMax(farKeys[bucket], key);
}

#elif defined(PASS_IDS)

void main() {
  uint key = fragmentKey(), pixel = pixelIndex(), id = fragmentId();
  uint bucket = pixel * uint(K) + bucketOf(pixel, key);
  if (key == nearKeys[bucket]) atomicMax(nearIds[bucket], id << 1 | id >> 31);
  else if (key == farKeys[bucket]) atomicMax(farIds[bucket], id << 1 | id >> 31);
}

#elif defined(PASS_RESOLVE)

#include "core/gl/fold.glsl"

bool deliverOne(uint key, uint id) {
  foldFront(id >> 1 | id << 31);
  return foldCloseGroup(key);
}

void main() {
  uint first = pixelIndex() * uint(K);
  foldLoad(COPEEL_FRONT);
  for (uint bucket = first; bucket < first + uint(K); ++bucket) {
    uint near = nearKeys[bucket], far = farKeys[bucket];
    if (near == COPEEL_KEY_NONE) continue;
    if (deliverOne(near, nearIds[bucket])) break;
    if (far > near && deliverOne(far, farIds[bucket])) break;
  }
  foldStore(COPEEL_FRONT);
}

#endif
