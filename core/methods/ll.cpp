// A-buffer in per-pixel linked lists, sorted when all fragments are there.
// Based on: Yang, Hensley, Grün, Thibieroz. Real-Time Concurrent Linked List Construction on the GPU. Computer Graphics Forum 29(4), 2010.
// Changed: a list that is too short is counted on, grown to what was asked for, and the pass repeated; long lists are merge-sorted in place.
// Passes: 1, or 2 while it grows (+1 with +occupancy). Bytes: 4 a pixel + 12 a node + 68 (the paper: 3N + 3 words a pixel).
// Loses: nothing, unless --memory does not let it grow: then `overflow` fragments. With +occupancy: what lies behind the interval of the k-th fragment.
#include "core/methods/lists.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawLl(gl::Frame& frame, const MethodOptions& options) { return drawLists(frame, options, "core/methods/ll.glsl", 1); }

}  // namespace copeel
