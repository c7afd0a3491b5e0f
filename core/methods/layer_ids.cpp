// Peeling coplanar fragments by their ids, in constant memory: each iteration delivers those of a layer with the least and the greatest primitive
// (f2b-2p, f2b-3p, and at both ends of the pixel dual-2p), or the greatest alone (f2b-zf); a layer is left when it has no others.
//
// Based on: Vasilakis, Fudos. Z-fighting aware Depth Peeling. SIGGRAPH 2011 posters, Algorithm 1 (f2b-zf). Vasilakis, Fudos. Depth-Fighting Aware
// Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, sections 3.1.1 and 3.1.2.
// Changed: minima, maxima and counts are integer atomics, since ids above 2^24 are no floats. An id carries its side, so the papers' pass that
// fetches the fragments has only the next layer to find; f2b-3p, which has a pass for each, fetches the sides in its third and leaves out the depth
// pass of an iteration in which no pixel goes to its next layer.
// Passes, with I = max over pixels of the iterations: f2b-zf 2 N + 1 (I = N); f2b-2p and dual-2p 2 I + 1, I = Σ ⌈C(Z)/2⌉ from one end, about
// half of it from both; f2b-3p at most 3 I + 1. The one more is the first depth pass; the last one finds nothing.
// Bytes per pixel: 8 + 20 from the front (8 + 28 f2b-3p), 16 + 40 dual. The papers: 40, dual 80. Loses: nothing.
#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

const std::string kFile = "core/methods/layer_ids.glsl";

MethodCounts peelIds(Layers& layers, gl::Frame& frame, const char* fragmentsAtOnce) {
  const gl::Defines defines = {{"FRAGMENTS_AT_ONCE", fragmentsAtOnce}};
  const gl::Program& select = layers.gatherProgram(kFile, "SELECT");
  const gl::Program& resolve = layers.resolveProgram(kFile, "RESOLVE", defines);
  frame.pixelWords("idRanges", 1, 5 * layers.sides());
  frame.drawPixels(layers.resolveProgram(kFile, "BEGIN", defines));
  MethodCounts counts;
  for (; layers.next(); ++counts.iterations) {
    frame.drawGeometry(select);
    frame.drawPixels(resolve);
  }
  return counts;
}

}  // namespace

MethodCounts drawF2bZf(gl::Frame& frame, const MethodOptions& options) {
  Layers layers(frame, Ends::Front, options);
  return peelIds(layers, frame, "1");
}

MethodCounts drawF2b2p(gl::Frame& frame, const MethodOptions& options) {
  Layers layers(frame, Ends::Front, options);
  return peelIds(layers, frame, "2");
}

MethodCounts drawDual2p(gl::Frame& frame, const MethodOptions& options) {
  Layers layers(frame, Ends::Both, options);
  return peelIds(layers, frame, "2");
}

MethodCounts drawF2b3p(gl::Frame& frame, const MethodOptions& options) {
  Layers layers(frame, Ends::Front, options);
  const gl::Defines defines = {{"FRAGMENTS_AT_ONCE", "2"}, {"SHADED", "1"}};
  const gl::Program& select = layers.gatherProgram(kFile, "SELECT", defines);
  const gl::Program& shade = layers.gatherProgram(kFile, "SHADE", defines);
  const gl::Program& resolve = layers.resolveProgram(kFile, "RESOLVE", defines);
  frame.pixelWords("idRanges", 1, 5);
  frame.pixelWords("shadedIds", 2, 2);
  const gl::Buffer& leaving = frame.buffer("leaving", 3, 4);
  frame.drawPixels(layers.resolveProgram(kFile, "BEGIN", defines));
  MethodCounts counts;
  for (bool seek = true; !seek || layers.next(); ++counts.iterations) {
    frame.drawGeometry(select);
    frame.drawGeometry(shade);
    leaving.clear(0);
    frame.drawPixels(resolve);
    // While every pixel stays where it is, so does its depth.
    seek = leaving.read<std::uint32_t>(1)[0] != 0;
  }
  return counts;
}

}  // namespace copeel
