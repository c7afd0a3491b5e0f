// Bucket peeling with linked lists: the scene's depth range is cut into five uniform intervals, each with a list a pixel and a counter of its own. Fragments
// of different buckets need no sorting, and fewer of them wait for one counter.
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, section 3.1.4.
// As there, all buckets have memory for the same number of fragments. Changed: it grows to what the fullest bucket asked for, and the pass is repeated.
// Passes: 1, or 2 while it grows. Bytes: 20 a pixel + 60 times the fragments of the fullest bucket + 324 (the paper: 3N + 8 to 15N + 8 words a pixel).
// Loses: nothing, unless --memory does not let it grow: then `overflow` fragments.
#include "core/methods/lists.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

constexpr std::uint32_t kBuckets = 5;

}  // namespace

MethodCounts drawBunLl(gl::Frame& frame, const MethodOptions& options) {
  MethodOptions all = options;
  all.occupancy = false;
  return drawLists(frame, all, "core/methods/bun_ll.glsl", kBuckets, 1);
}

}  // namespace copeel
