// Counts the fragments of some pixels: see auto.cpp.
#include "core/gl/frame.glsl"

layout(std430, binding = COPEEL_BUFFER_METHOD) coherent buffer Seen { uint seen[]; };

void main() { atomicAdd(seen[pixelIndex()], 1u); }
