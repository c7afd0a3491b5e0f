// Vertices to clip coordinates, once a view, in double: geometry passes then read the same 16 bytes, so equal positions stay equal.
// One invocation a vertex of an object; whose it is, a search among the objects' first vertices tells.
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
  uint perspective, objectCount, firstClip, clipCount;   // of this dispatch: from firstClip to before clipCount
};

// The last object that begins at the vertex or before: those without vertices begin where the next one does.
uint objectOf(uint clip) {
  uint first = 0u, last = objectCount - 1u;
  while (first < last) {
    uint middle = (first + last + 1u) / 2u;
    if (placements[middle].firstClip <= clip) first = middle;
    else last = middle - 1u;
  }
  return first;
}

void main() {
  uint clip = firstClip + gl_GlobalInvocationID.x;
  if (clip >= clipCount) return;
  Placement placement = placements[objectOf(clip)];
  uint i = clip - placement.firstClip;
  uint v = (placement.firstVertex + i) * 3u;
  dvec3 world = placement.columns[0].xyz * vertices[v] + placement.columns[1].xyz * vertices[v + 1u] +
                placement.columns[2].xyz * vertices[v + 2u] + placement.columns[3].xyz;
  dvec3 p = world - eye.xyz;
  double t = dot(forward.xyz, p);
  double w = perspective != 0u ? t : 1.0LF;
  clips[clip] = vec4(float(dot(clipX.xyz, p) - clipX.w * w), float(dot(clipY.xyz, p) - clipY.w * w),
                     float(depth.x * t + depth.y), float(w));
}
