#include "core/methods/k_buffer.h"

#include <fmt/format.h>

#include "core/methods/arrays.h"
#include "core/methods/occupancy.h"

namespace copeel {
namespace {

// From here on log K steps of a heap are fewer than K steps of a search.
constexpr std::uint32_t kLeastHeap = 17;

}  // namespace

MethodCounts drawNearest(gl::Frame& frame, const MethodOptions& options, const char* file, const gl::Defines& more) {
  gl::Defines defines = more;
  defines.emplace_back("K", fmt::format("{}", options.k));
  if (options.k >= kLeastHeap) defines.emplace_back("K_HEAP", "1");
  gl::Defines gatherDefines = drawOccupancy(frame, options);
  gatherDefines.insert(gatherDefines.end(), defines.begin(), defines.end());
  frame.pixelWords("seen", 0).clear(0);
  const gl::Buffer& nearest = frame.pixelWords("nearest", 1, 2 * std::size_t{options.k});
  frame.pixelWords("kept", 2).clear(0);
  const gl::Buffer& missed = frame.buffer("missed", 3, 8);
  missed.clear(0);
  frame.drawGeometry(frame.geometryProgram(file, "GATHER", gatherDefines));
  deliverArrays(frame, file, nearest, options.k, {}, defines);
  const std::vector<std::uint32_t> words = missed.read<std::uint32_t>(2);
  return {.iterations = 1, .overflow = words[0], .repeats = 0, .hazards = words[1]};
}

}  // namespace copeel
