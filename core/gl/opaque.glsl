// The nearest opaque fragment of each pixel: a pass over opaque objects before the method's own, which then leave out what lies behind (fragment.glsl).
#include "core/gl/fragment.glsl"

void main() { atomicMin(opaqueKeys[pixelIndex()], fragmentKey()); }
