// What every pass knows: the image, and which pixel it stands on. Row 0 is the upper one, as in our images.
#include "core/gl/layout.h"

layout(std140, binding = COPEEL_BLOCK_FRAME) uniform Frame {
  dvec2 center;            // image centre less the sample's offset in its pixel, pixels
  double depthOrigin;      // see fragment.glsl
  uvec2 depthNearest;      // bits of the nearest value: low word, high word
  int depthShift;
  int depthSign;
  ivec2 size;              // pixels
  int depthHardware;       // 1: the rasterizer's own depth, as in the papers
  uint depthKeys;          // keys in use: COPEEL_KEY_LEAST and so many from there on
};

uint pixelIndex() { return uint(gl_FragCoord.y) * uint(size.x) + uint(gl_FragCoord.x); }
