// Peeling layer by layer, the fragments of a layer in a k-buffer: f2b-kb from the front, dual-kb from both ends, and f2b-kb-zf, whose k-buffer is
// sorted.
//
// Based on: Vasilakis, Fudos. Z-fighting aware Depth Peeling. SIGGRAPH 2011 posters, section 2 (F2BKB-ZF). Vasilakis, Fudos. Depth-Fighting Aware
// Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, section 3.2.1, Algorithm 3 (F2B-KB). Bavoil et al. Multi-Fragment Effects on the GPU using
// the k-Buffer. I3D 2007.
// Changed: a slot is taken by compare-and-swap, where the papers' read and write may meet another fragment's. f2b-kb-zf inserts by id, each slot
// keeping the greater by an atomic maximum and handing the lesser on: what stays are the K last primitives, whatever the order of arrival.
// Passes: 2 D and one that finds nothing, dual 2 ⌈D / 2⌉ and one.
// Bytes per pixel: 8 + 4 K, dual 16 + 8 K; 4 besides. The papers: K + 3 and K + 4 words, dual K + 4 and K + 6.
// Loses: of a layer of C(Z) fragments all but K, R_h = Σ min(K, C(Z)) / N; `overflow` counts them. --memory may shorten K.
#include "core/methods/layers.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

const std::string kFile = "core/methods/layer_kb.glsl";

MethodCounts peelBuffers(gl::Frame& frame, const MethodOptions& options, Ends ends, const gl::Defines& defines) {
  Layers layers(frame, ends, options);
  const std::uint32_t length = layers.fittingLength(options, 0);
  const gl::Program& gather = layers.gatherProgram(kFile, "GATHER", defines);
  const gl::Program& resolve = layers.resolveProgram(kFile, "RESOLVE", defines);
  gather.set("k", length);
  resolve.set("k", length);
  frame.pixelWords("slots", 1, length * layers.sides()).clear(0);
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

MethodCounts drawF2bKb(gl::Frame& frame, const MethodOptions& options) { return peelBuffers(frame, options, Ends::Front, {}); }
MethodCounts drawDualKb(gl::Frame& frame, const MethodOptions& options) { return peelBuffers(frame, options, Ends::Both, {}); }
MethodCounts drawF2bKbZf(gl::Frame& frame, const MethodOptions& options) { return peelBuffers(frame, options, Ends::Front, {{"SORTED", "1"}}); }

}  // namespace copeel
