// Front-to-back depth peeling: see f2b.cpp.
#if defined(PASS_PEEL)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif

layout(std430, binding = COPEEL_BUFFER_METHOD) buffer Peeled { uint peeled[]; };   // key of the last layer

#if defined(PASS_PEEL)

layout(location = 0) out uint id;

// The nearest fragment behind the last layer; of several at one depth the first to arrive stays, as the depth test decides.
void main() {
  uint key = fragmentKey();
  if (key <= peeled[pixelIndex()]) discard;
  gl_FragDepth = uintBitsToFloat(key);
  id = fragmentId();
}

#elif defined(PASS_RESOLVE)

layout(binding = 0) uniform usampler2D ids;
layout(binding = 8) uniform sampler2D depths;

void main() {
  uint key = floatBitsToUint(texelFetch(depths, ivec2(gl_FragCoord.xy), 0).r);
  if (key == COPEEL_KEY_NONE) return;
  foldLoad(COPEEL_FRONT);
  foldFront(texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r);
  bool enough = foldCloseGroup(key);
  foldStore(COPEEL_FRONT);
  peeled[pixelIndex()] = enough ? COPEEL_KEY_DONE : key;
}

#endif
