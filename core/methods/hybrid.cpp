// Peeling by depth where a layer holds one fragment, by id where it holds several: each pass takes a pixel to its next layer, or further into the
// one it is in, whichever it needs, so that only pixels in which fragments are coplanar pay for it.
//
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, section 5, which leaves open a method that
// peels as usual and turns to the overlapping fragments on demand. How it is done here is ours.
// The depth test keeps the first drawn of the nearest fragments, which is the one of the least primitive: one pass finds layer and fragment. A minimum
// per pixel marks whether a second one was met at that depth. Then the pixel stays: further passes take the least and the greatest primitive left.
// Passes: max over pixels of Σ (1 + ⌊C(Z) / 2⌋), and one that finds nothing: f2b's D + 1 where nothing is coplanar, never more than f2b2's where C <= 3,
// below f2b-2p's 2 Σ ⌈C(Z) / 2⌉ + 1 and f2b-3p's elsewhere.
// Bytes per pixel: 28 (least key left, depth buffer, id, four words of the layer). Loses: nothing.
#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawHybrid(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "core/methods/hybrid.glsl";
  Layers layers(frame, Ends::Front, options);
  const gl::Program& peel = layers.gatherProgram(file, "PEEL");
  const gl::Program& resolve = layers.resolveProgram(file, "RESOLVE");
  frame.pixelWords("within layers", 1, 4);
  frame.drawPixels(layers.resolveProgram(file, "BEGIN"));
  frame.target("ids", 0, GL_R32UI);
  frame.writeTargets(1);
  MethodCounts counts;
  for (; layers.next(peel); ++counts.iterations) frame.drawPixels(resolve);
  return counts;
}

}  // namespace copeel
