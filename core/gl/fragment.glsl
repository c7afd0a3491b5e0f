// A fragment of a geometry pass: its id and its depth key.
//
// The key comes from the order value s of the triangle's plane class at this pixel (core/coplanarity/depth_planes.h), never from the triangle: all
// fragments of a class have one key, to the bit. v = sign · s - origin lies in one octave where the view allows it (and in a few where the eye
// is near), so the difference of its bits to the nearest one's, shifted to 30 bits, is a uniform (or else a relative) depth.
#include "core/gl/frame.glsl"

struct Primitive {
  uint planeClass, object;
};
layout(std430, binding = COPEEL_BUFFER_PRIMITIVES) readonly buffer Primitives { Primitive primitives[]; };

// Read as texels, which llvmpipe fetches for all lanes at once: half the cost of a fragment was here. Two texels a plane: a, b; c, lo and hi. One a primitive.
layout(binding = COPEEL_TEXTURE_PLANES) uniform usamplerBuffer planes;
layout(binding = COPEEL_TEXTURE_PRIMITIVES) uniform usamplerBuffer primitiveTexels;

#ifdef HIDE_BEHIND_OPAQUE
layout(std430, binding = COPEEL_BUFFER_OPAQUE) coherent buffer Opaque { uint opaqueKeys[]; };   // of each pixel, the nearest opaque fragment's
#endif

flat in uint firstPrimitive;

uint fragmentPrimitive() { return firstPrimitive + uint(gl_PrimitiveID); }

uint fragmentId() { return fragmentPrimitive() | (gl_FrontFacing ? 0u : COPEEL_ID_BACK); }

// A 64-bit difference a - b >= 0, shifted right by depthShift (1 … 31).
uint shiftedDifference(uvec2 a, uvec2 b) {
  uint low = a.x - b.x;
  uint high = a.y - b.y - (a.x < b.x ? 1u : 0u);
  return (high << (32 - depthShift)) | (low >> depthShift);
}

uint keyOfPlane(uint planeClass) {
  uvec4 slopes = texelFetch(planes, int(planeClass) * 2), rest = texelFetch(planes, int(planeClass) * 2 + 1);
  double a = packDouble2x32(slopes.xy), b = packDouble2x32(slopes.zw), c = packDouble2x32(rest.xy);
  double lo = double(uintBitsToFloat(rest.z)), hi = double(uintBitsToFloat(rest.w));
  precise double u = double(int(gl_FragCoord.x)) - center.x;
  precise double v = double(int(gl_FragCoord.y)) - center.y;
  precise double s = clamp(a * u + (b * v + c), lo, hi);
  precise double value = double(depthSign) * s - depthOrigin;
  uvec2 bits = unpackDouble2x32(value);
  return COPEEL_KEY_LEAST + (depthSign > 0 ? shiftedDifference(bits, depthNearest) : shiftedDifference(depthNearest, bits));
}

// A plane that holds the eye is seen as a line, and what clipping leaves of its triangles is no fragment.
uint fragmentClass() {
  uint planeClass = texelFetch(primitiveTexels, int(fragmentPrimitive())).r;
  uvec2 range = texelFetch(planes, int(planeClass) * 2 + 1).zw;
  if (uintBitsToFloat(range.x) > uintBitsToFloat(range.y)) discard;
  return planeClass;
}

// To be asked before anything is written. For folds that say so, what is behind something opaque is no fragment either (Frame::hideBehind).
uint fragmentKey() {
  uint planeClass = fragmentClass();
  uint key = depthHardware != 0 ? clamp(floatBitsToUint(gl_FragCoord.z), COPEEL_KEY_LEAST, COPEEL_KEY_NONE - 1u) : keyOfPlane(planeClass);
#ifdef HIDE_BEHIND_OPAQUE
  if (key > opaqueKeys[pixelIndex()]) discard;
#endif
  return key;
}

// For passes that count fragments: what is none, as fragmentKey() says, at less cost where no key is needed to know it.
void discardNoFragment() {
#ifdef HIDE_BEHIND_OPAQUE
  fragmentKey();
#else
  fragmentClass();
#endif
}
