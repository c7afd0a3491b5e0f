#include "core/methods/buckets.h"

#include "core/gl/layout.h"

namespace copeel {

void drawBucketPairs(gl::Frame& frame, const char* file, std::uint32_t k, const gl::Defines& defines) {
  frame.pixelWords("near keys", 0, k).clear(COPEEL_KEY_NONE);
  frame.pixelWords("far keys", 1, k).clear(0);
  frame.pixelWords("near ids", 2, k).clear(0);
  frame.pixelWords("far ids", 3, k).clear(0);
  frame.drawGeometry(frame.geometryProgram(file, "KEYS", defines));
  frame.drawGeometry(frame.geometryProgram(file, "IDS", defines));
  frame.beginStates();
  frame.drawPixels(frame.pixelProgram(file, "RESOLVE", defines));
}

}  // namespace copeel
