// Chooses among the robust methods by a look at the scene: fragments and depth complexity, and the memory that there is.
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, section 4.4, as a rule of thumb: buffers
// where memory allows, constant memory where it does not.
// A look is a pass that counts the fragments of the image at a fourth of its width and height (small images: of all pixels); later frames use its
// numbers until they prove too small. First comes fab, as long as the arrays for the deepest pixel fit; then ll, which takes what the fragments
// take; sb, which takes less for each of them; hybrid in constant memory. A method that finds its memory too short delivers nothing
// and leaves the frame to the next one, so that a look that saw too little costs time and no fragment. Images too large for states (Frame::statesFit)
// have all memory there is, and hybrid says that it cannot draw them.
// Passes: those of the method, the look's and those of methods that were too short. Bytes: those of the method, at most --memory where that is 28 a
// pixel or more. Loses: nothing.
#include <algorithm>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

#include "core/gl/frame.h"
#include "core/methods/arrays.h"
#include "core/methods/methods_gl.h"

namespace copeel {
namespace {

constexpr std::size_t kSmallImage = 1 << 16;                       // pixels
constexpr int kStep = 4;                                           // pixels of a larger one from one that is counted to the next
constexpr std::uint64_t kUnlimited = std::uint64_t{2} << 30;       // bytes, without --memory, where hybrid can take over
constexpr std::uint64_t kEndless = std::uint64_t{1} << 62;         // where it cannot
constexpr std::uint64_t kDeliveryBytes = 8;                        // beside the buffers that fab and sb hold to --memory

struct Candidate {
  const char* name;
  DrawMethod draw;
  std::uint64_t bytes;    // that it needs by the look
};

// The look at some pixels has seen a share of the fragments, and not the deepest pixel.
gl::Look lookAtScene(gl::Frame& frame, bool atAllPixels) {
  const int step = atAllPixels || frame.pixelCount() <= kSmallImage ? 1 : kStep;
  const int width = (frame.width() + step - 1) / step, height = (frame.height() + step - 1) / step;
  const std::size_t words = static_cast<std::size_t>(frame.width()) * static_cast<std::size_t>(height);
  const gl::Buffer& seen = frame.buffer("look", 0, words * 4);
  seen.clear(0);
  frame.drawAtSize(width, height);
  frame.drawGeometry(frame.geometryProgram("core/methods/auto.glsl", "LOOK"));
  frame.drawAtSize(frame.width(), frame.height());
  const std::vector<std::uint32_t> counts = seen.read<std::uint32_t>(words);
  frame.releaseBuffers();
  const std::uint64_t sum = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
  return {sum * static_cast<std::uint64_t>(step) * static_cast<std::uint64_t>(step), counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end())};
}

}  // namespace

MethodCounts drawAuto(gl::Frame& frame, const MethodOptions& options) {
  if (!frame.look || frame.look->wasTooLittle) frame.look = lookAtScene(frame, frame.look.has_value());
  const gl::Look look = *frame.look;
  const bool statesFit = frame.statesFit();
  const std::uint64_t pixels = frame.pixelCount(), budget = options.memoryBytes ? options.memoryBytes : statesFit ? kUnlimited : kEndless;
  const Candidate candidates[] = {{"fab", drawFab, pixels * (4 + 8 * std::max<std::uint64_t>(look.deepest, 1)) + 12 + kDeliveryBytes},
                                  {"ll", drawLl, pixels * 4 + look.fragments * 12 + 68 + kDeliveryBytes},
                                  {"sb", drawSb, pixels * 8 + look.fragments * 8 + 264 + kDeliveryBytes},
                                  {"hybrid", drawHybrid, 28 * pixels}};
  MethodOptions own = options;
  own.k = std::max(look.deepest, 1u);
  own.occupancy = false;
  own.allOrNothing = true;
  own.memoryBytes = budget > kDeliveryBytes ? budget - kDeliveryBytes : 1;
  std::string tooShort;
  for (const Candidate& candidate : candidates) {
    const bool last = &candidate == std::end(candidates) - 1;
    const bool wantsStates = candidate.draw != drawLl && look.deepest > kShortArray;
    if ((candidate.bytes > budget || (wantsStates && !statesFit)) && !last) continue;
    MethodCounts counts = candidate.draw(frame, own);
    if (counts.repeats > 0 || counts.overflow > 0) frame.look->wasTooLittle = true;
    if (counts.overflow > 0) {
      frame.releaseBuffers();
      tooShort += fmt::format("; {} was too short", candidate.name);
      continue;
    }
    counts.chosen = candidate.name;
    counts.reason = fmt::format("{} fragments, {} in a pixel: {} bytes of {}{}", look.fragments, look.deepest, candidate.bytes, budget, tooShort);
    return counts;
  }
  return {};
}

}  // namespace copeel
