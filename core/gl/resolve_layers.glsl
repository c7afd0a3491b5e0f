// The resolve pass of a method that peels layer by layer. The file that includes this defines bool resolveSide(uint side, uint key): delivers
// what was gathered of the side's layer, closes or keeps the layer, and says whether the pixel has enough.
void main() {
  uint front = layerKey(COPEEL_FRONT);
  bool any = front != COPEEL_KEY_NONE, enough = false;
#ifdef DUAL
  uint back = layerKey(COPEEL_BACK);
  any = any || back != COPEEL_KEY_NONE;
#endif
  if (front != COPEEL_KEY_NONE) enough = resolveSide(COPEEL_FRONT, front);
#ifdef DUAL
  if (back != COPEEL_KEY_NONE && !enough) enough = resolveSide(COPEEL_BACK, back);
#endif
  // Where nothing is left, no object is waited for.
  if (enough || !any) layerEnd();
  else layerSeek();
}
