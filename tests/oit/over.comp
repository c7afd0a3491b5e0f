// over.glsl as a shader has it: every function is called, and the language's own compiler judges.
#version 450
#extension GL_GOOGLE_include_directive : require
#include "core/fold/common_glsl.h"
#include "core/fold/over.glsl"

layout(local_size_x = 1) in;
layout(std430, binding = 0) buffer Fragments { vec4 fragments[]; };
layout(std430, binding = 1) buffer Levels { uvec4 levels[]; };

void main() {
  OverState front, back;
  overBegin(front);
  overBegin(back);
  for (int i = 0; i < fragments.length() && !overEnough(front); ++i) {
    overFragment(front, overShade(fragments[i], 0.75));
    overBehind(back, fragments[i]);
  }
  levels[gl_GlobalInvocationID.x] = uvec4(overLevels(overResult(overJoin(front, back), vec3(255.0))), 255u);
}
