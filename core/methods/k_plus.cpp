// k⁺-buffer: the K nearest fragments, one fragment of a pixel at a time, by a spin lock or the device's interlock.
// Based on: Vasilakis, Fudos. k⁺-buffer: Fragment Synchronized k-buffer. I3D 2014.
// As there: a fragment farther than all that are kept turns back before the lock; an array for small K, a max-heap from K = 17 on.
// Changed: lock and count share a word. Passes: 1 (+1 with +occupancy). Bytes per pixel: 8 K + 8 (the paper, as k-buffer: 2K + 2 words).
// Loses: all but the K nearest, R_h = min(K, N) / N, whatever the order of drawing.
#include "core/gl/context.h"
#include "core/methods/k_buffer.h"
#include "core/methods/methods_gl.h"

namespace copeel {

MethodCounts drawKPlus(gl::Frame& frame, const MethodOptions& options) {
  gl::Defines defines;
  if (gl::hasExtension("GL_ARB_fragment_shader_interlock")) defines.emplace_back("K_INTERLOCK", "1");
  return drawNearest(frame, options, "core/methods/k_plus.glsl", defines);
}

}  // namespace copeel
