// A-buffer in per-pixel linked lists: see ll.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif

struct Node {
  uint next, key, id;
};
layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Heads { uint heads[]; };     // index + 1 of a pixel's first node, 0: none
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) buffer Nodes { Node nodes[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer Counter { uint wanted; };

#if defined(PASS_GATHER)

uniform uint capacity;   // nodes

void main() {
  uint key = fragmentKey();
  uint node = atomicAdd(wanted, 1u);
  if (node >= capacity) return;
  nodes[node] = Node(atomicExchange(heads[pixelIndex()], node + 1u), key, fragmentId());
}

#elif defined(PASS_RESOLVE)

#define LIST_NODES nodes
#include "core/gl/sort_list.glsl"

void main() {
  uint head = sortList(heads[pixelIndex()]);
  if (head == 0u) return;
  foldLoad(COPEEL_FRONT);
  deliverList(head);
  foldStore(COPEEL_FRONT);
}

#endif
