// Uniform intervals of the scene's depth range. Monotonic in the key (each operation is), so that a fragment in a later interval lies behind.
float depthShare(uint key) {
  return depthHardware != 0 ? uintBitsToFloat(key) : float(key - COPEEL_KEY_LEAST) / float(depthKeys);
}
uint intervalOf(uint key, uint intervals) { return min(uint(depthShare(key) * float(intervals)), intervals - 1u); }
