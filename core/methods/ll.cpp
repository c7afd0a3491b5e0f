// A-buffer in per-pixel linked lists, sorted when all fragments are there.
// Based on: Yang, Hensley, Grün, Thibieroz. Real-Time Concurrent Linked List Construction on the GPU. Computer Graphics Forum 29(4), 2010.
// Changed: a list that is too short is counted on, grown to what was asked for, and the pass repeated; long lists are merge-sorted in place. Pictures of more than
// 2^17 pixels have eight memories for the nodes of eight sets of tiles, as large as the fullest needs, where --memory holds them.
// Passes: 1, or 2 while it grows (+1 with +occupancy; again where it is found that eight memories do not fit). Bytes: 4 a pixel + 12 a node + 68; with eight
// memories 96 times the nodes of the fullest instead, + 516 (the paper: 3N + 3 words a pixel).
// Loses: nothing, unless --memory does not let it grow: then `overflow` fragments. With +occupancy: what lies behind the interval of the k-th fragment.
#include "core/methods/lists.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

constexpr std::uint32_t kParts = 8;
constexpr std::size_t kMostOfOneMemory = 1 << 17;   // pixels

}  // namespace

MethodCounts drawLl(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "core/methods/ll.glsl";
  if (frame.pixelCount() > kMostOfOneMemory && !frame.nodesInOneMemory) {
    MethodOptions all = options;
    all.allOrNothing = true;
    const MethodCounts counts = drawLists(frame, all, file, 1, kParts);
    if (counts.overflow == 0) return counts;
    frame.nodesInOneMemory = true;
  }
  return drawLists(frame, options, file, 1, 1);
}

}  // namespace copeel
