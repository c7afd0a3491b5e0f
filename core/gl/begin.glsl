// The passes of every frame whose fold has states in memory: their beginning, and their results at the end.
#include "core/gl/frame.glsl"
#include "core/gl/fold.glsl"

void main() {
#ifdef PASS_BEGIN
  foldInitial(COPEEL_FRONT);
  foldInitial(COPEEL_BACK);
#else
  foldFinish();
#endif
}
