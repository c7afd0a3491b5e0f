// A fragment of a geometry pass: its id and its depth key.
//
// The key comes from the order value s of the triangle's plane class at this pixel (core/coplanarity/depth_planes.h), never from the triangle: all
// fragments of a class have one key, to the bit. v = sign · s - origin lies in one octave where the view allows it (and in a few where the eye
// is near), so the difference of its bits to the nearest one's, shifted to 30 bits, is a uniform (or else a relative) depth.
#include "core/gl/frame.glsl"

struct DepthPlane {
  double a, b, c;
  float lo, hi;
};
struct Primitive {
  uint planeClass, object;
};
layout(std430, binding = COPEEL_BUFFER_PLANES) readonly buffer Planes { DepthPlane planes[]; };
layout(std430, binding = COPEEL_BUFFER_PRIMITIVES) readonly buffer Primitives { Primitive primitives[]; };

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
  DepthPlane plane = planes[planeClass];
  precise double u = double(int(gl_FragCoord.x)) - center.x;
  precise double v = double(int(gl_FragCoord.y)) - center.y;
  precise double s = clamp(plane.a * u + (plane.b * v + plane.c), double(plane.lo), double(plane.hi));
  precise double value = double(depthSign) * s - depthOrigin;
  uvec2 bits = unpackDouble2x32(value);
  return COPEEL_KEY_LEAST + (depthSign > 0 ? shiftedDifference(bits, depthNearest) : shiftedDifference(depthNearest, bits));
}

// To be asked before anything is written: a plane that holds the eye is seen as a line, and what clipping leaves of its triangles is no fragment.
uint fragmentKey() {
  uint planeClass = primitives[fragmentPrimitive()].planeClass;
  if (planes[planeClass].lo > planes[planeClass].hi) discard;
  if (depthHardware != 0) return clamp(floatBitsToUint(gl_FragCoord.z), COPEEL_KEY_LEAST, COPEEL_KEY_NONE - 1u);
  return keyOfPlane(planeClass);
}
