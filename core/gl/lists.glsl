// Linked lists of fragments, LISTS of them a pixel one behind the other, each with a node memory of its own: gathered by gatherIntoList(), resolved by the
// passes that drawLists() draws (core/methods/lists.h).
//
// Lists of few fragments are sorted in registers. Pixels with a longer one wait for passes that each merge one level, as drivers end shaders that loop for
// too long (sort_array.glsl); a level of LIST_MOST nodes takes 3 turns a node.
#define LIST_MOST 20000u

struct Node {
  uint next, key, id;
};
layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Heads { uint heads[]; };     // index + 1 of a list's first node, 0: none
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) buffer Nodes { Node nodes[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer Wanted { uint wanted[]; };   // nodes of each memory, 16 words apart
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer Longest { uint longest; };   // list that was put off

#if defined(PASS_GATHER)

uniform uint capacity;   // nodes of a memory

void gatherIntoList(uint list, uint key) {
  uint node = atomicAdd(wanted[list * 16u], 1u);
  if (node >= capacity) return;
  node += list * capacity;
  nodes[node] = Node(atomicExchange(heads[pixelIndex() * uint(LISTS) + list], node + 1u), key, fragmentId());
}

#else

#include "core/gl/fold.glsl"
#include "core/gl/sort_short.glsl"
#define LIST_NODES nodes
#include "core/gl/sort_list.glsl"

#if defined(PASS_RESOLVE)

uint lengthOf(uint list) {
  uint length = 0u;
  for (uint node = heads[list]; node != 0u && length <= LIST_MOST; node = nodes[node - 1u].next) ++length;
  return length;
}

// Fetches, sorts and delivers a list of few fragments, which ends at 0; else returns true, and nothing was delivered.
bool fetchShort(uint list, out uint count) {
  count = 0u;
  uint node = heads[list];
  for (; node != 0u && count < uint(SORT_SHORT); ++count) {
    sortedKeys[count] = nodes[node - 1u].key, sortedIds[count] = nodes[node - 1u].id;
    node = nodes[node - 1u].next;
  }
  return node == 0u;
}

void main() {
  uint first = pixelIndex() * uint(LISTS);
#if LISTS > 1
  bool any = false, tooLong = false;
  for (uint list = first; list < first + uint(LISTS); ++list) any = any || heads[list] != 0u;
  if (!any) return;
  for (uint list = first; list < first + uint(LISTS); ++list) {
    uint length = lengthOf(list);
    if (length > uint(SORT_SHORT)) atomicMax(longest, length), tooLong = true;
  }
  if (tooLong) return;
#else
  if (heads[first] == 0u) return;
#endif
  foldLoad(COPEEL_FRONT);
  for (uint list = first; list < first + uint(LISTS); ++list) {
    uint count;
    if (!fetchShort(list, count)) {
      atomicMax(longest, lengthOf(list));
      return;
    }
    sortShort(count);
    heads[list] = 0u;
    if (deliverShort(count)) {
      for (uint rest = list; rest < first + uint(LISTS); ++rest) heads[rest] = 0u;
      break;
    }
  }
  foldStore(COPEEL_FRONT);
}

#elif defined(PASS_MERGE)

uniform uint run;

void main() {
  uint first = pixelIndex() * uint(LISTS), merges;
  for (uint list = first; list < first + uint(LISTS); ++list) {
    if (heads[list] != 0u) heads[list] = mergeRuns(heads[list], run, merges);
  }
}

#elif defined(PASS_LONG)

void main() {
  uint first = pixelIndex() * uint(LISTS);
  foldLoad(COPEEL_FRONT);
  for (uint list = first; list < first + uint(LISTS); ++list) {
    if (deliverList(heads[list])) break;
  }
  foldStore(COPEEL_FRONT);
}

#endif
#endif
