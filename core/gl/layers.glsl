// The depth layers that each pixel is peeled at: the nearest one left (side COPEEL_FRONT), and with the define DUAL also the farthest one left
// (COPEEL_BACK). find_layer.glsl finds them; gather passes ask which layer a fragment lies on; resolve passes close layers, or keep them
// while some of their fragments are not delivered. A layer that is nearest and farthest at once is the front's, unless the back has begun it.
#ifdef DUAL

#define LAYER_SIDES 2u
#define LAYER_KEPT 0x80000000u   // of `to`, above all keys: the back side is within the layer there

// What is left lies in [from, to]; nearest and farthest of it, COPEEL_KEY_NONE and 0 where nothing is.
struct LayerRange {
  uint from, to, nearest, farthest;
};
layout(std430, binding = COPEEL_BUFFER_METHOD) buffer Layers { LayerRange layers[]; };

void layerBegin() { layers[pixelIndex()] = LayerRange(0u, COPEEL_KEY_NONE, COPEEL_KEY_NONE, 0u); }

// Whether anything left may have a key of [least, most].
bool layerAdmits(uint least, uint most) {
  uint i = pixelIndex();
  return layers[i].from <= most && least <= (layers[i].to & ~LAYER_KEPT);
}

uint layerKey(uint side) {
  LayerRange range = layers[pixelIndex()];
  if (range.nearest < range.farthest) return side == COPEEL_FRONT ? range.nearest : range.farthest;
  bool keptByBack = (range.to & LAYER_KEPT) != 0u;
  return keptByBack == (side == COPEEL_BACK) ? range.nearest : COPEEL_KEY_NONE;
}

void layerClose(uint side, uint key) {
  if (side == COPEEL_FRONT) layers[pixelIndex()].from = key + 1u;
  else layers[pixelIndex()].to = key - 1u;
}

void layerKeep(uint side, uint key) {
  if (side == COPEEL_FRONT) layers[pixelIndex()].from = key;
  else layers[pixelIndex()].to = key | LAYER_KEPT;
}

void layerEnd() { layers[pixelIndex()] = LayerRange(COPEEL_KEY_DONE, 0u, COPEEL_KEY_NONE, 0u); }

// Forgets what was found, so that the next layers can be.
void layerSeek() { layers[pixelIndex()].nearest = COPEEL_KEY_NONE, layers[pixelIndex()].farthest = 0u; }

#else

#define LAYER_SIDES 1u

layout(std430, binding = COPEEL_BUFFER_METHOD) buffer Layers { uint layers[]; };   // the least key that is left
layout(binding = 8) uniform sampler2D layerDepths;

void layerBegin() { layers[pixelIndex()] = 0u; }
bool layerAdmits(uint least, uint most) { return layers[pixelIndex()] <= most; }
uint layerKey(uint side) { return floatBitsToUint(texelFetch(layerDepths, ivec2(gl_FragCoord.xy), 0).r); }
void layerClose(uint side, uint key) { layers[pixelIndex()] = key + 1u; }
void layerKeep(uint side, uint key) { layers[pixelIndex()] = key; }
void layerEnd() { layers[pixelIndex()] = COPEEL_KEY_DONE; }
void layerSeek() {}

#endif

// Which side's layer a key is on; false: none's. No loop: NVIDIA's compiler (580.159) leaves `side` wrong where a loop returns.
bool layerOf(uint key, out uint side) {
  side = COPEEL_FRONT;
  bool found = key == layerKey(COPEEL_FRONT);
#ifdef DUAL
  if (!found) {
    side = COPEEL_BACK;
    found = key == layerKey(COPEEL_BACK);
  }
#endif
  return found;
}
