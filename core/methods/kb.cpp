// k-buffer: each fragment reads the K fragments of its pixel and writes back the nearest K. Nothing keeps two fragments of a pixel apart while they do.
// Based on: Bavoil, Callahan, Lefohn, Comba, Silva. Multi-Fragment Effects on the GPU Using the k-Buffer. I3D 2007.
// Changed: fragments that meet in a pixel are noticed and reported as hazards; llvmpipe works on a pixel's fragments one by one and has none.
// Passes: 1 (+1 with +occupancy). Bytes per pixel: 8 K + 8 (the paper: 2K + 2 words).
// Loses: all but the K nearest, R_h = min(K, N) / N; with hazards, more.
#include "core/methods/k_buffer.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawKb(gl::Frame& frame, const MethodOptions& options) { return drawNearest(frame, options, "core/methods/kb.glsl"); }

}  // namespace copeel
