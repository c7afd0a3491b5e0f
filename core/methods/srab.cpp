// Stencil-routed A-buffer: the n-th fragment that arrives at a pixel goes to its n-th place, the first K are kept, near or far.
// Based on: Myers, Bavoil. Stencil Routed A-Buffer. SIGGRAPH 2007 sketches.
// Changed: an atomic counter routes rather than the stencil test of a multisampled target, so that K is not bound to the samples there are, and
// what comes too late is counted. One pass only: further passes, for input sorted by depth, would split coplanar groups.
// Passes: 1 (+1 with +occupancy). Bytes per pixel: 8 K + 4, and 8 (the paper: 3K + 2 words).
// Loses: all but the first K drawn, R_h = min(K, N) / N. With +occupancy fewer of those are wasted on what lies behind the k-th.
#include <fmt/format.h>

#include "core/methods/arrays.h"
#include "core/methods/methods_gl.h"
#include "core/methods/occupancy.h"

namespace copeel {

MethodCounts drawSrab(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "core/methods/srab.glsl";
  const gl::Defines defines = {{"K", fmt::format("{}", options.k)}};
  gl::Defines gatherDefines = drawOccupancy(frame, options);
  gatherDefines.insert(gatherDefines.end(), defines.begin(), defines.end());
  frame.pixelWords("arrived", 0).clear(0);
  const gl::Buffer& routed = frame.pixelWords("routed", 1, 2 * std::size_t{options.k});
  const gl::Buffer& missed = frame.buffer("missed", 3, 4);
  missed.clear(0);
  frame.drawGeometry(frame.geometryProgram(file, "GATHER", gatherDefines));
  deliverArrays(frame, file, routed, options.k, {}, defines);
  return {.iterations = 1, .overflow = missed.read<std::uint32_t>(1)[0]};
}

}  // namespace copeel
