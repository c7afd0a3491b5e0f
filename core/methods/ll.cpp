// A-buffer in per-pixel linked lists, sorted when all fragments are there.
// Based on: Yang, Hensley, Grün, Thibieroz. Real-Time Concurrent Linked List Construction on the GPU. Computer Graphics Forum 29(4), 2010.
// Changed: a list that is too short is counted on, grown to what was asked for, and the pass repeated; lists are merge-sorted in place, so that no pixel
// is too deep. Passes: 1, or 2 while it grows. Bytes: 4 a pixel + 12 a node (the paper: 3N + 3 words a pixel).
// Loses: nothing, unless --memory does not let it grow: then `overflow` fragments.
#include "core/gl/frame.h"
#include "core/methods/methods_gl.h"

#include <algorithm>

namespace copeel {
namespace {

constexpr std::size_t kNodeBytes = 12;
constexpr std::size_t kFirstNodesPerPixel = 4;

}  // namespace

MethodCounts drawLl(gl::Frame& frame, const MethodOptions& options) {
  const gl::Program& gather = frame.geometryProgram("core/methods/ll.glsl", "GATHER");
  const gl::Program& resolve = frame.pixelProgram("core/methods/ll.glsl", "RESOLVE");
  const gl::Buffer& heads = frame.pixelWords("heads", 0);
  const gl::Buffer& counter = frame.buffer("counter", 2, 4);
  const std::size_t most = options.memoryBytes ? std::max(options.memoryBytes, heads.bytes() + 1024) - heads.bytes() : ~std::size_t{0};
  std::size_t bytes = std::min(std::max(frame.keptBytes("nodes"), frame.pixelCount() * kFirstNodesPerPixel * kNodeBytes), most);
  MethodCounts counts{.iterations = 1};
  for (;; ++counts.repeats) {
    const std::size_t capacity = bytes / kNodeBytes;
    frame.buffer("nodes", 1, bytes);
    heads.clear(0);
    counter.clear(0);
    gather.set("capacity", static_cast<GLuint>(capacity));
    frame.noDepthTest();
    frame.drawGeometry(gather);
    const std::size_t wanted = counter.read<std::uint32_t>(1)[0];
    counts.overflow = wanted > capacity ? wanted - capacity : 0;
    if (counts.overflow == 0 || bytes >= most) break;
    bytes = std::min(wanted * kNodeBytes, most);
  }
  frame.drawPixels(resolve);
  return counts;
}

}  // namespace copeel
