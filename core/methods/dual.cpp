// Dual depth peeling: one pass takes the nearest and the farthest layer left and finds the next two between them.
// Based on: Bavoil, Myers. Order Independent Transparency with Dual Depth Peeling. NVIDIA technical report, 2008.
// Changed: nearest, farthest and ids are integer atomics, where the report blends floats; of several fragments at one depth the one of the last
// primitive stays, whatever the order of arrival; a middle layer is the front's.
// Passes: ⌈D / 2⌉ + 1 (the first finds the ends). Bytes per pixel: 24 (what is left, what is next, two ids); the papers' table says 6 words too.
// Loses: all but one fragment of each group, R_h = D / N.
#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawDual(gl::Frame& frame, const MethodOptions& options) {
  Layers layers(frame, Ends::Both, options);
  const gl::Program& peel = layers.gatherProgram("core/methods/dual.glsl", "PEEL");
  const gl::Program& resolve = layers.resolveProgram("core/methods/dual.glsl", "RESOLVE");
  frame.pixelWords("dualIds", 1, 2).clear(0);
  MethodCounts counts;
  for (bool any = true; any; ++counts.iterations) {
    any = layers.next(peel);
    frame.drawPixels(resolve);
  }
  return counts;
}

}  // namespace copeel
