// Front-to-back depth peeling: see f2b.cpp.
#if defined(PASS_PEEL)
#include "core/gl/fragment.glsl"
#else
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"
#endif
#include "core/gl/layers.glsl"

#if defined(PASS_PEEL)

layout(location = 0) out uint id;

// The nearest fragment behind the last layer; of several at one depth the first to arrive stays, as the depth test decides.
void main() {
  uint key = fragmentKey();
  if (!layerAdmits(key, key)) discard;
  gl_FragDepth = uintBitsToFloat(key);
  id = fragmentId();
}

#elif defined(PASS_RESOLVE)

layout(binding = 0) uniform usampler2D ids;

void main() {
  uint key = layerKey(COPEEL_FRONT);
  bool enough = key == COPEEL_KEY_NONE;
  if (!enough) {
    foldLoad(COPEEL_FRONT);
    foldFront(texelFetch(ids, ivec2(gl_FragCoord.xy), 0).r);
    enough = foldCloseGroup(key);
    foldStore(COPEEL_FRONT);
  }
  if (enough) layerEnd();
  else layerClose(COPEEL_FRONT, key);
}

#endif
