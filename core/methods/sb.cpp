// S-buffer: counts the fragments of each pixel, gives each its place by a prefix sum on the device, and fills memory that is exactly large enough.
// Based on: Vasilakis, Fudos. S-buffer: Sparsity-aware Multi-fragment Rendering. Eurographics 2012 (short papers).
// As there, pixels are hashed to S = 32 counters, H(P) = (y · width + x) mod S, so that they do not all wait for one.
// Passes: 2. Bytes: 8 a pixel + 8 N + 8 S + 4 (the paper: 2N + 3 words a pixel).
// Loses: nothing, unless --memory is too small: then `overflow` fragments, those of the last pixels of the last groups.
#include <algorithm>

#include <fmt/format.h>

#include "core/methods/arrays.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

constexpr std::uint32_t kGroups = 32;   // the paper's optimum is about 30
constexpr std::size_t kGroupBytes = (2 * kGroups + 1) * sizeof(std::uint32_t);

}  // namespace

MethodCounts drawSb(gl::Frame& frame, const MethodOptions& options) {
  const char* const file = "core/methods/sb.glsl";
  const gl::Defines defines = {{"SB_GROUPS", fmt::format("{}", kGroups)}};
  const gl::Buffer& pixelCounts = frame.pixelWords("counts", 0);
  const gl::Buffer& places = frame.pixelWords("places", 1);
  const gl::Buffer& groups = frame.buffer("groups", 2, kGroupBytes);
  pixelCounts.clear(0);
  groups.clear(0);
  frame.drawGeometry(frame.geometryProgram(file, "COUNT", defines));
  frame.drawPixels(frame.pixelProgram(file, "PLACE", defines));
  frame.drawPixels(frame.pixelProgram(file, "PREFIX", defines), {0, 0, 1, 1});

  // The size of the memory is the one number that has to come back from the device.
  const std::size_t total = groups.read<std::uint32_t>(2 * kGroups + 1).back();
  const std::size_t most = roomFor(options.memoryBytes, pixelCounts.bytes() + places.bytes() + groups.bytes(), 8) / 8;
  const std::size_t capacity = std::min(total, most);
  if (capacity < total && options.allOrNothing) return {.iterations = 1, .overflow = total - capacity};
  const gl::Buffer& fragments = frame.buffer("fragments", 3, capacity * 8);
  const gl::Program& fill = frame.geometryProgram(file, "FILL", defines);
  fill.set("capacity", static_cast<GLuint>(capacity));
  frame.drawGeometry(fill);
  deliverArrays(frame, file, fragments, capacity, {{"capacity", static_cast<GLuint>(capacity)}}, defines);
  return {.iterations = 1, .overflow = total - capacity};
}

}  // namespace copeel
