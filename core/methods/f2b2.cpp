// Two-pass front-to-back depth peeling: a pass for depth alone, then one that shades what lies at that depth. The papers' measure of what early
// depth tests gain.
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, section 4.
// Changed: keys come from plane classes, in the shader, so the second pass tests late too. Passes: 2 D, and one that finds nothing.
// Bytes per pixel: 12 (least key left, id, depth buffer); the paper's table says 3 words too.
// Loses: all but one fragment of each group, the last drawn: R_h = D / N.
#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawF2b2(gl::Frame& frame, const MethodOptions& options) {
  Layers layers(frame, Ends::Front, options);
  const gl::Program& shade = layers.gatherProgram("core/methods/f2b2.glsl", "SHADE");
  const gl::Program& resolve = layers.resolveProgram("core/methods/f2b.glsl", "RESOLVE");
  frame.target("ids", 0, GL_R32UI);
  MethodCounts counts;
  while (layers.next()) {
    frame.writeTargets(1);
    frame.testDepth(GL_EQUAL, false);
    frame.drawGeometry(shade);
    frame.writeTargets(0);
    frame.noDepthTest();
    frame.drawPixels(resolve);
    ++counts.iterations;
  }
  return counts;
}

}  // namespace copeel
