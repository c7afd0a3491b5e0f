// Linked lists of fragments, LISTS of them a pixel one behind the other in depth, each with PARTS node memories of its own: gathered by gatherIntoList(), resolved
// by the passes that drawLists() draws (core/methods/lists.h).
//
// Pixels of few fragments are sorted in the invocation (sort_short.glsl). The others wait, for a pass that has room for more, then for passes that each merge
// one level, as drivers end shaders that loop for too long (sort_array.glsl); a level of LIST_MOST nodes takes 3 turns a node.
#define LIST_MOST 20000u
#define LIST_LONG 0x80000000u    // of the first head of a pixel that was put off

struct Node {
  uint next, key, id;
};
layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Heads { uint heads[]; };     // index + 1 of a list's first node, 0: none
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) buffer Nodes { Node nodes[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer Wanted { uint wanted[]; };   // nodes of each memory, 16 words apart
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer Longest { uint longest; };   // pixel that was put off, its lists together

#if LISTS > 5
#error a pixel has at most five lists
#endif

// The heads of one list lie together: surfaces are in few buckets, and while fragments are gathered the others' heads stay out of the caches.
uint headOf(uint list) { return list * uint(size.x * size.y) + pixelIndex(); }

#if defined(PASS_GATHER)

uniform uint capacity;   // nodes of a memory

// Neighbouring tiles of 64 x 64 pixels have different memories: a core of llvmpipe draws a tile at a time, and cores that fill one memory wait for each other's
// counter and cache lines.
uint memoryOf(uint list) {
#if PARTS > 1
  uvec2 tile = uvec2(gl_FragCoord.xy) >> 6;
  return list * uint(PARTS) + (tile.x + 3u * tile.y) % uint(PARTS);
#else
  return list;
#endif
}

void gatherIntoList(uint list, uint key) {
  uint memory = memoryOf(list), node = atomicAdd(wanted[memory * 16u], 1u);
  if (node >= capacity) return;
  node += memory * capacity;
  nodes[node] = Node(atomicExchange(heads[headOf(list)], node + 1u), key, fragmentId());
}

#else

#include "core/gl/fold.glsl"
#include "core/gl/sort_short.glsl"
#define LIST_NODES nodes
#include "core/gl/sort_list.glsl"

#if defined(PASS_RESOLVE)

layout(binding = COPEEL_TEXTURE_METHOD) uniform usamplerBuffer headTexels;
layout(binding = COPEEL_TEXTURE_METHOD + 1) uniform usamplerBuffer nodeTexels;

uint lengthOf(uint list) {
  uint length = 0u;
  for (uint node = heads[headOf(list)]; node != 0u && length <= LIST_MOST; node = nodes[node - 1u].next) ++length;
  return length;
}

// Lists follow one another in depth, so one sort of all their fragments leaves each where it is. They are walked in one loop, a fragment a turn: lanes that run
// in lock step then wait for the longest pixel, not for the longest list of each bucket. Of at most five lists the later ones are a vector, from which empty ones
// are taken first: llvmpipe keeps an array in memory, and the walk took four times as long.
void main() {
  uint node = texelFetch(headTexels, int(headOf(0u))).r;
#ifdef PUT_OFF_BEFORE
  if ((node & LIST_LONG) == 0u) discard;
  node &= ~LIST_LONG;
  heads[headOf(0u)] = node;
#endif
  uvec4 later = uvec4(0u);
  for (uint list = 1u; list < uint(LISTS); ++list) later[list - 1u] = texelFetch(headTexels, int(headOf(list))).r;
  if (later.z == 0u) later = uvec4(later.xyw, 0u);
  if (later.y == 0u) later = uvec4(later.xzw, 0u);
  if (later.x == 0u) later = uvec4(later.yzw, 0u);
  if (node == 0u) node = later.x, later = uvec4(later.yzw, 0u);
  if (node == 0u) foldSkip();
  beginShort();
  while (node != 0u && shortCount < uint(SORT_SHORT)) {
    uvec4 words = texelFetch(nodeTexels, int(node - 1u));
    putShort(words.yz);
    node = words.x;
    if (node == 0u) node = later.x, later = uvec4(later.yzw, 0u);
  }
  if (node != 0u) {
#ifdef MORE_ROOM_FOLLOWS
    atomicMax(longest, uint(SORT_SHORT) + 1u);
#else
    uint length = 0u;
    for (uint list = 0u; list < uint(LISTS); ++list) length += lengthOf(list);
    atomicMax(longest, length);
#endif
    heads[headOf(0u)] |= LIST_LONG;
    return;
  }
  foldOpen();
  deliverShort();
  foldShut();
}

#elif defined(PASS_MERGE)

uniform uint run;

void main() {
  uint merges, mark = heads[headOf(0u)] & LIST_LONG;
  if (mark == 0u) return;
  heads[headOf(0u)] &= ~LIST_LONG;
  for (uint list = 0u; list < uint(LISTS); ++list) {
    if (heads[headOf(list)] != 0u) heads[headOf(list)] = mergeRuns(heads[headOf(list)], run, merges);
  }
  heads[headOf(0u)] |= mark;
}

#elif defined(PASS_LONG)

void main() {
  if ((heads[headOf(0u)] & LIST_LONG) == 0u) return;
  foldOpen();
  for (uint list = 0u; list < uint(LISTS); ++list) {
    if (deliverList(heads[headOf(list)] & ~LIST_LONG)) break;
  }
  foldShut();
}

#endif
#endif
