// Front-to-back depth peeling: one depth layer a pass, nearest first. The baseline of all papers here, and what z-fighting breaks: of several
// fragments at one depth it keeps one, the first drawn.
// Based on: Everitt, Cass. Interactive Order-Independent Transparency. NVIDIA technical report, 2001.
// Passes: D + 1 (the last finds nothing). Bytes per pixel: 12 (key of the layer before, id, depth buffer); the paper's table says 3 words too.
// Loses: all but one fragment of each group, R_h = D / N.
#include "core/gl/frame.h"
#include "core/methods/draw.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawF2b(gl::Frame& frame, const MethodOptions&) {
  const gl::Program& peel = frame.geometryProgram("core/methods/f2b.glsl", "PEEL");
  const gl::Program& resolve = frame.pixelProgram("core/methods/f2b.glsl", "RESOLVE");
  frame.pixelWords("peeled", 0).clear(0);
  frame.target("ids", 0, GL_R32UI);
  frame.writeTargets(1);
  MethodCounts counts;
  for (;;) {
    frame.clearDepth();
    frame.testDepth(GL_LESS, true);
    if (!frame.anySamplesOf([&] { frame.drawGeometry(peel); })) break;
    frame.drawPixels(resolve);
    ++counts.iterations;
  }
  return counts;
}

}  // namespace copeel
