// Peeling layer by layer into linked lists: see layer_ll.cpp.
#if defined(PASS_GATHER)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif
#include "core/gl/layers.glsl"

struct Node {
  uint next, id;
};
layout(std430, binding = COPEEL_BUFFER_METHOD + 1) coherent buffer Heads { uint heads[]; };   // per pixel and side, index + 1; 0: none
layout(std430, binding = COPEEL_BUFFER_METHOD + 2) buffer Nodes { Node nodes[]; };
layout(std430, binding = COPEEL_BUFFER_METHOD + 3) coherent buffer Counters { uint wanted[2]; };

#if defined(PASS_GATHER)

uniform uint capacity, frontCapacity, backCapacity;   // nodes

void main() {
  uint side;
  if (!layerOf(fragmentKey(), side)) return;
  // The back's nodes run from the end of the buffer towards its beginning.
  uint node = atomicAdd(wanted[side], 1u);
  if (node >= (side == COPEEL_FRONT ? frontCapacity : backCapacity)) return;
  if (side == COPEEL_BACK) node = capacity - 1u - node;
  nodes[node] = Node(atomicExchange(heads[pixelIndex() * LAYER_SIDES + side], node + 1u), fragmentId());
}

#elif defined(PASS_RESOLVE)

uint listKey;   // of the whole list

#define LIST_NODES nodes
#define LIST_KEY(node) listKey
#include "core/gl/sort_list.glsl"

bool resolveSide(uint side, uint key) {
  uint at = pixelIndex() * LAYER_SIDES + side;
  listKey = key;
  foldLoad(side);
  bool enough = deliverList(sortList(heads[at]));
  foldStore(side);
  heads[at] = 0u;
  layerClose(side, key);
  return enough;
}

#include "core/gl/resolve_layers.glsl"

#endif
