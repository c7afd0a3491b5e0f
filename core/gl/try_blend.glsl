#include "core/gl/fragment.glsl"
layout(std430, binding = COPEEL_BUFFER_METHOD) buffer Layers { uvec4 layers[]; };
layout(location=0) out vec2 mm;
void main() {
  uint key = fragmentKey();
  uvec4 r = layers[pixelIndex()];
  if (key < r.x || key > r.y) discard;
  mm = vec2(-uintBitsToFloat(key), uintBitsToFloat(key));
}
