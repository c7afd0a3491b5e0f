// The one vertex shader of every geometry pass: positions were projected once for the view (project.comp.glsl).
#include "core/gl/layout.h"

layout(location = COPEEL_ATTRIBUTE_CLIP) in vec4 clip;
layout(location = COPEEL_ATTRIBUTE_FIRST_PRIMITIVE) in uint first;

flat out uint firstPrimitive;

void main() {
  gl_Position = clip;
  firstPrimitive = first;
}
