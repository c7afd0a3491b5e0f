// Peeling layer by layer, the fragments of a layer in an array of K per pixel: f2b-fab from the front, dual-fab from both ends.
//
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, section 3.2.1, Algorithm 3 (F2B-B, DUAL-B).
// Changed: the counter goes on past K, where the paper's starts again at 0 and overwrites: the first K to arrive stay, the others are counted.
// Passes: 2 D and one that finds nothing, dual 2 ⌈D / 2⌉ and one.
// Bytes per pixel: 8 + 4 (K + 1), dual 16 + 8 (K + 1); 4 besides. The paper: K + 4 and K + 6 words.
// Loses: of a layer of C(Z) fragments all but K, R_h = Σ min(K, C(Z)) / N; `overflow` counts them. --memory may shorten K.
#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

const std::string kFile = "core/methods/layer_fab.glsl";

MethodCounts peelArrays(gl::Frame& frame, const MethodOptions& options, Ends ends) {
  Layers layers(frame, ends, options);
  const std::uint32_t length = layers.fittingLength(options, 1);
  const gl::Program& gather = layers.gatherProgram(kFile, "GATHER");
  const gl::Program& resolve = layers.resolveProgram(kFile, "RESOLVE");
  gather.set("k", length);
  resolve.set("k", length);
  frame.pixelWords("slots", 1, length * layers.sides());
  frame.pixelWords("slotCounts", 2, layers.sides()).clear(0);
  const gl::Buffer& overflow = frame.buffer("slotOverflow", 3, 4);
  overflow.clear(0);
  MethodCounts counts;
  for (; layers.next(); ++counts.iterations) {
    frame.drawGeometry(gather);
    frame.drawPixels(resolve);
  }
  counts.overflow = overflow.read<std::uint32_t>(1)[0];
  return counts;
}

}  // namespace

MethodCounts drawF2bFab(gl::Frame& frame, const MethodOptions& options) { return peelArrays(frame, options, Ends::Front); }
MethodCounts drawDualFab(gl::Frame& frame, const MethodOptions& options) { return peelArrays(frame, options, Ends::Both); }

}  // namespace copeel
