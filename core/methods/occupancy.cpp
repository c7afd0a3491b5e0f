// Occupancy maps: a pass over the geometry marks which of S = 32 d intervals of depth hold fragments of a pixel; the k-th mark from the front bounds
// where the k nearest lie, and what lies behind it is rejected before it is stored.
// Based on: Vasilakis, Papaioannou. Improving k-buffer Methods via Occupancy Maps. Eurographics 2015 (short papers).
// Changed: intervals are those of the scene's depth range, as the paper allows. Our depth is that of the plane class, which the rasterizer does not know, so
// the bound is read by the shader rather than by early z; it is an interval, not a depth, so that the comparison is exact.
// Passes: 1. Bytes per pixel: 4 (d + 1) (the paper: d - k + 3 words).
// Loses: nothing of the k nearest (Lemma 2.1). Of one interval's fragments all survive, whatever their number.
#include "core/methods/occupancy.h"

#include "core/error.h"

namespace copeel {

gl::Defines drawOccupancy(gl::Frame& frame, const MethodOptions& options) {
  if (!options.occupancy) return {};
  const std::uint32_t words = options.occupancyWords;
  COPEEL_CHECK(words >= 1 && words <= 64, "{} words of occupancy", words);
  const char* const file = "core/methods/occupancy.glsl";
  const gl::Defines defines = {{"OCCUPANCY", fmt::format("{}", words * 32)}, {"OCCUPANCY_K", fmt::format("{}", options.k)}};
  frame.pixelWords("occupancy", 5, words).clear(0);
  frame.pixelWords("occupancy limits", 6);
  frame.drawGeometry(frame.geometryProgram(file, "FILL", defines));
  frame.drawPixels(frame.pixelProgram(file, "COUNT", defines));
  return defines;
}

}  // namespace copeel
