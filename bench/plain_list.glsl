// A linked list as the textbook has it: see plain_list.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif

struct Node {
  uint next, key, id;
};
layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Heads { uint heads[]; };   // index + 1 of a pixel's first node, 0: none
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) buffer Nodes { Node nodes[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) coherent buffer Counter { uint nodeCount; };

#if defined(PASS_GATHER)

uniform uint capacity;   // nodes

void main() {
  uint key = fragmentKey();
  uint node = atomicAdd(nodeCount, 1u);
  if (node >= capacity) return;
  nodes[node] = Node(atomicExchange(heads[pixelIndex()], node + 1u), key, fragmentId());
}

#else

#define MOST 128   // fragments of a pixel; more are lost

uint keys[MOST], ids[MOST];

uint copyList() {
  uint count = 0u;
  for (uint node = heads[pixelIndex()]; node != 0u && count < uint(MOST); node = nodes[node - 1u].next) {
    keys[count] = nodes[node - 1u].key, ids[count] = nodes[node - 1u].id;
    ++count;
  }
  return count;
}

// Nearest first, of coplanar fragments the later primitive: the order of all methods, so that pictures can be compared.
bool isBefore(uint key, uint id, uint otherKey, uint otherId) {
  return key < otherKey || (key == otherKey && (id & COPEEL_ID_PRIMITIVE) > (otherId & COPEEL_ID_PRIMITIVE));
}

void insertionSort(uint count) {
  for (uint i = 1u; i < count; ++i) {
    uint key = keys[i], id = ids[i], at = i;
    for (; at > 0u && isBefore(key, id, keys[at - 1u], ids[at - 1u]); --at) keys[at] = keys[at - 1u], ids[at] = ids[at - 1u];
    keys[at] = key, ids[at] = id;
  }
}

// Straight from the pixel's own variables.
void main() {
  uint count = copyList();
  insertionSort(count);
  OverState state;
  overBegin(state);
  uint nearest = 0u, largest = 0u, group = 0u;
  for (uint i = 0u; i < count; ++i) {
    uint primitive = ids[i] & COPEEL_ID_PRIMITIVE;
    vec4 color = overColorOf(primitive);
    overFragment(state, color);
    if (nearest == 0u && color.a > 0.0) nearest = primitive + 1u;
    group = i > 0u && keys[i] == keys[i - 1u] ? group + 1u : 1u;
    largest = max(largest, group);
  }
  overWrite(state, nearest, count, largest);
}

#endif
