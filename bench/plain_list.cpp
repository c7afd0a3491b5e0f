// Based on: Yang, Hensley, Grün, Thibieroz. Real-Time Concurrent Linked List Construction on the GPU. Computer Graphics Forum 29(4), 2010: one counter
// for all nodes, heads a pixel, nodes copied to an array of the invocation, sorted by insertion and blended. Nothing else is done for it and nothing against
// it: keys, order and blending are those of the methods that it is compared with, so that the pictures are equal.
// Passes: 1, over the pixels 1. Bytes: 4 a pixel + 12 a node + 16.
#include "bench/plain_list.h"

#include "core/gl/frame.h"

namespace copeel::bench {

MethodCounts drawPlainList(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "bench/plain_list.glsl";
  const std::size_t capacity = frame.pixelCount() * options.k;
  const gl::Program& gather = frame.geometryProgram(file, "GATHER");
  const gl::Buffer& heads = frame.pixelWords("plain heads", 0);
  frame.buffer("plain nodes", 1, capacity * 12);
  const gl::Buffer& counter = frame.buffer("plain counter", 2, 4);
  heads.clear(0);
  counter.clear(0);
  gather.set("capacity", static_cast<GLuint>(capacity));
  frame.drawGeometry(gather);
  frame.drawPixels(frame.pixelProgram(file, "RESOLVE"));
  const std::size_t wanted = counter.read<std::uint32_t>(1)[0];
  return {.iterations = 1, .overflow = wanted > capacity ? wanted - capacity : 0};
}

}  // namespace copeel::bench
