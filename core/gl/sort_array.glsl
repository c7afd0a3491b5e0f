// Sorts the contiguous fragments of a pixel and delivers them: for the methods that gather into arrays. The file that includes this defines ARRAY, an
// array of records uvec2 {key, id}, and calls deliverArray() for every pixel in the passes RESOLVE, BEGIN, HEAP, POP and FINISH that deliverArrays() draws
// (core/methods/arrays.h), which defines SORT_SHORT.
//
// Short arrays are sorted in the invocation. Longer ones become heaps where they lie, in rounds of ARRAY_ROUND steps: drivers end shaders that loop for too long
// (llvmpipe silently, after 65,536 turns of all loops together), so no pixel may ask for more in one pass. A step is a sift of at most 31 turns, which
// leaves half of the turns to the fold.
#include "core/gl/sort_short.glsl"

#define ARRAY_ROUND 1024u

// Where fragment i of the array from `first` is.
#ifndef ARRAY_PLACE
#define ARRAY_PLACE(first, i) ((first) + (i))
#endif

layout(std430, binding = COPEEL_BUFFER_METHOD + 7) coherent buffer Longest { uint longest; };   // array that was put off

#if defined(PASS_RESOLVE)

layout(binding = COPEEL_TEXTURE_METHOD) uniform usamplerBuffer arrayTexels;

// Delivers, or puts off what is too long.
void deliverArray(uint first, uint count) {
  if (count == 0u) foldSkip();
  if (count > uint(SORT_SHORT)) {
    atomicMax(longest, count);
    return;
  }
  // Later primitives come last and lie in front of their coplanar ones, so the array is read from its end.
  beginShort();
  for (uint i = count; i > 0u; --i) putShort(texelFetch(arrayTexels, int(ARRAY_PLACE(first, i - 1u))).xy);
  foldOpen();
  deliverShort();
  foldShut();
}

#elif defined(PASS_BEGIN)

// Rounds keep states in memory, also where pixels of short arrays need none.
void deliverArray(uint first, uint count) {
  if (count <= uint(SORT_SHORT)) return;
  foldInitial(COPEEL_FRONT);
  foldInitial(COPEEL_BACK);
}

#elif defined(PASS_FINISH)

void deliverArray(uint first, uint count) {
  if (count > uint(SORT_SHORT)) foldFinish();
}

#else

uniform uint arrayRound;

// Lets fragment `moving` sink from node `at` to its place in the heap of the first `size` fragments; the nearest is at its root.
void siftDown(uint first, uint size, uint at, uvec2 moving) {
  for (uint child = 2u * at + 1u; child < size; child = 2u * at + 1u) {
    uvec2 nearest = ARRAY[ARRAY_PLACE(first, child)];
    if (child + 1u < size) {
      uvec2 other = ARRAY[ARRAY_PLACE(first, child + 1u)];
      if (fragmentBefore(other, nearest)) nearest = other, ++child;
    }
    if (!fragmentBefore(nearest, moving)) break;
    ARRAY[ARRAY_PLACE(first, at)] = nearest;
    at = child;
  }
  ARRAY[ARRAY_PLACE(first, at)] = moving;
}

#if defined(PASS_HEAP)

// Round r makes heaps of the subtrees at nodes count/2 - 1 - r · ARRAY_ROUND and before.
void deliverArray(uint first, uint count) {
  if (count <= uint(SORT_SHORT)) return;
  uint done = arrayRound * ARRAY_ROUND, inner = count / 2u;
  for (uint step = 0u; step < ARRAY_ROUND && done + step < inner; ++step) {
    uint node = inner - 1u - done - step;
    siftDown(first, count, node, ARRAY[ARRAY_PLACE(first, node)]);
  }
}

#elif defined(PASS_POP)

// Round r delivers ARRAY_ROUND fragments behind the r · ARRAY_ROUND nearest. What is popped lies behind the heap; its last key tells whether the group
// that the round before left open goes on. A pixel that has enough is marked by a last popped key of COPEEL_KEY_DONE.
void deliverArray(uint first, uint count) {
  uint size = count - min(count, arrayRound * ARRAY_ROUND);
  if (count <= uint(SORT_SHORT) || size == 0u) return;
  uint key = size < count ? ARRAY[ARRAY_PLACE(first, size)].x : COPEEL_KEY_NONE;
  uint end = size - min(size, ARRAY_ROUND);
  bool enough = key == COPEEL_KEY_DONE;
  foldLoad(COPEEL_FRONT);
  for (; size > end && !enough; --size) {
    uvec2 nearest = ARRAY[ARRAY_PLACE(first, 0u)];
    if (key != COPEEL_KEY_NONE && nearest.x != key) enough = foldCloseGroup(key);
    if (enough) break;
    key = nearest.x;
    foldFront(nearest.y);
    siftDown(first, size - 1u, 0u, ARRAY[ARRAY_PLACE(first, size - 1u)]);
    ARRAY[ARRAY_PLACE(first, size - 1u)] = nearest;
  }
  if (size == 0u && !enough) foldCloseGroup(key);
  if (enough) ARRAY[ARRAY_PLACE(first, end)].x = COPEEL_KEY_DONE;
  foldStore(COPEEL_FRONT);
}

#endif
#endif
