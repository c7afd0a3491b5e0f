// A-buffer in fixed-size arrays: as many places for each pixel as the deepest one needs.
// Based on: Liu, Huang, Liu, Wu. FreePipe: a Programmable Parallel Rendering Architecture for Efficient Multi-Fragment Effects. I3D 2010;
// Crassin. Fast and Accurate Single-Pass A-Buffer Using OpenGL 4.0+. 2010.
// Changed: fragments that find no place are counted, and the arrays grow to what the deepest pixel asked for and the pass is repeated.
// Passes: 1, or 2 while it grows. Bytes per pixel: 4 + 8 max(K, N) (the paper: 2D + 2 words).
// Loses: nothing, unless --memory does not let it grow: then `overflow` fragments, the last ones drawn of pixels that are too deep.
#include <algorithm>

#include "core/methods/arrays.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawFab(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "core/methods/fab.glsl";
  const gl::Program& gather = frame.geometryProgram(file, "GATHER");
  const std::size_t perPlace = frame.pixelCount() * 8;
  const gl::Buffer& pixelCounts = frame.pixelWords("counts", 0);
  const gl::Buffer& overflow = frame.buffer("overflow", 2, 8);
  const std::size_t most = roomFor(options.memoryBytes, pixelCounts.bytes() + overflow.bytes(), 8) / perPlace;
  std::size_t capacity = std::min(std::max<std::size_t>(frame.keptBytes("fragments") / perPlace, options.k), most);
  MethodCounts counts{.iterations = 1};
  for (;; ++counts.repeats) {
    frame.buffer("fragments", 1, capacity * perPlace);
    pixelCounts.clear(0);
    overflow.clear(0);
    gather.set("capacity", static_cast<GLuint>(capacity));
    frame.drawGeometry(gather);
    const std::vector<std::uint32_t> missed = overflow.read<std::uint32_t>(2);
    counts.overflow = missed[0];
    if (counts.overflow == 0 || capacity >= most) break;
    capacity = std::min<std::size_t>(missed[1], most);
  }
  if (counts.overflow > 0 && options.allOrNothing) return counts;
  deliverArrays(frame, file, frame.buffer("fragments", 1, capacity * perPlace), capacity, {{"capacity", static_cast<GLuint>(capacity)}});
  return counts;
}

}  // namespace copeel
