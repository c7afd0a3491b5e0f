// Finds the next layers of every pixel (layers.glsl), and the objects that cannot have any fragment left.
#if defined(PASS_FIND)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#endif
#include "core/gl/layers.glsl"

#if defined(PASS_BEGIN)

void main() { layerBegin(); }

#elif defined(PASS_FIND)

// One side leaves the nearest key to the depth test; two need a minimum and a maximum, which it cannot hold.
void main() {
  uint key = fragmentKey();
  if (!layerAdmits(key, key)) discard;
#ifdef DUAL
  uint i = pixelIndex();
  if (key < layers[i].nearest) atomicMin(layers[i].nearest, key);
  if (key > layers[i].farthest) atomicMax(layers[i].farthest, key);
#else
  gl_FragDepth = uintBitsToFloat(key);
#endif
}

#elif defined(PASS_BOX)

uniform uint leastKey, greatestKey;   // that the object can have

void main() {
  if (!layerAdmits(leastKey, greatestKey)) discard;
}

#endif
