// Front-to-back depth peeling: one depth layer a pass, nearest first. The baseline of all papers here, and what z-fighting breaks: of several
// fragments at one depth it keeps one, the first drawn.
// Based on: Everitt, Cass. Interactive Order-Independent Transparency. NVIDIA technical report, 2001.
// Passes: D + 1 (the last finds nothing). Bytes per pixel: 12 (least key left, id, depth buffer); the paper's table says 3 words too.
// Loses: all but one fragment of each group, R_h = D / N.
#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawF2b(gl::Frame& frame, const MethodOptions& options) {
  Layers layers(frame, Ends::Front, options);
  const gl::Program& peel = layers.gatherProgram("core/methods/f2b.glsl", "PEEL");
  const gl::Program& resolve = layers.resolveProgram("core/methods/f2b.glsl", "RESOLVE");
  frame.target("ids", 0, GL_R32UI);
  frame.writeTargets(1);
  MethodCounts counts;
  for (; layers.next(peel); ++counts.iterations) frame.drawPixels(resolve);
  return counts;
}

}  // namespace copeel
