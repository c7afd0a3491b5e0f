// Two-pass front-to-back depth peeling: see f2b2.cpp. Its resolve pass is f2b.glsl's.
#if defined(PASS_SHADE)

#include "core/gl/fragment.glsl"

layout(location = 0) out uint id;

void main() {
  gl_FragDepth = uintBitsToFloat(fragmentKey());
  id = fragmentId();
}

#endif
