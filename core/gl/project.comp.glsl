// Vertices to clip coordinates, once a view, in double: geometry passes then read the same 16 bytes, so equal positions stay equal.
// One column of invocations (y) per object.
#include "core/gl/layout.h"

layout(local_size_x = 64) in;

struct Placement {
  dvec4 columns[4];
  uint firstVertex, vertexCount, firstClip;
  uint padding[5];
};
layout(std430, binding = COPEEL_BUFFER_VERTICES) readonly buffer Vertices { double vertices[]; };
layout(std430, binding = COPEEL_BUFFER_PLACEMENTS) readonly buffer Placements { Placement placements[]; };
layout(std430, binding = COPEEL_BUFFER_CLIP) writeonly buffer Clip { vec4 clips[]; };

// The view's axes, scaled so that a dot product with (position - eye) gives clip coordinates.
layout(std140, binding = COPEEL_BLOCK_FRAME) uniform Projection {
  dvec4 eye;
  dvec4 clipX, clipY, forward;   // .w: sample offset, in clip coordinates, for x and y
  dvec4 depth;                   // clip z = depth.x · t + depth.y
  uint perspective, firstObject;
};

void main() {
  Placement placement = placements[firstObject + gl_GlobalInvocationID.y];
  uint i = gl_GlobalInvocationID.x;
  if (i >= placement.vertexCount) return;
  uint v = (placement.firstVertex + i) * 3u;
  dvec3 world = placement.columns[0].xyz * vertices[v] + placement.columns[1].xyz * vertices[v + 1u] +
                placement.columns[2].xyz * vertices[v + 2u] + placement.columns[3].xyz;
  dvec3 p = world - eye.xyz;
  double t = dot(forward.xyz, p);
  double w = perspective != 0u ? t : 1.0LF;
  clips[placement.firstClip + i] = vec4(float(dot(clipX.xyz, p) - clipX.w * w), float(dot(clipY.xyz, p) - clipY.w * w),
                                        float(depth.x * t + depth.y), float(w));
}
