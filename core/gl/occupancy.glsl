// +occupancy: see core/methods/occupancy.cpp. Gather passes ask beyondOccupancy() before they spend anything on a fragment.
#if defined(OCCUPANCY)
#include "core/gl/intervals.glsl"

layout(std430, binding = COPEEL_BUFFER_METHOD + 6) coherent buffer Limits { uint limits[]; };   // the interval of a pixel's k-th fragment, or a nearer end

bool beyondOccupancy(uint key) { return intervalOf(key, uint(OCCUPANCY)) > limits[pixelIndex()]; }
#else
bool beyondOccupancy(uint key) { return false; }
#endif
