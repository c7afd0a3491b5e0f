// Windings at the eye of closed leaves that it may be inside of: along a ray all crossings sum to minus the winding at its start. A geometry pass adds them
// up per pixel and leaf before the method draws; a pixel pass then applies them to the front state.
#if defined(PASS_SUM)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#endif
#include "core/gl/fold.glsl"

layout(std430, binding = COPEEL_BUFFER_FOLD_TABLE + 1) readonly buffer FromStack { uint fromStack[]; };   // per leaf

void main() {
  foldLoad(COPEEL_FRONT);
#if defined(PASS_SUM)
  discardNoFragment();
  // The open group's change is free for this: nothing was delivered yet.
  uint leaf = primitives[fragmentPrimitive()].object;
  if (fromStack[leaf] != 0u) atomicAdd(foldStates[csgLeafAt(leaf) + 1u], uint(gl_FrontFacing ? -1 : 1));
#else
  for (uint leaf = 0u; leaf < csg.leafCount; ++leaf) {
    uint at = csgLeafAt(leaf) + 1u;
    int start = int(foldStates[at]);
    foldStates[at] = 0u;
    if (start != 0) csgWind(leaf, start);
  }
  ++foldStates[csgBase + 3u];
#endif
}
