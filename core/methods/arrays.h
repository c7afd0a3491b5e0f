// Delivery of fragments that a method gathered into contiguous arrays: the passes of core/gl/sort_array.glsl.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/gl/frame.h"

namespace copeel {

// SORT_SHORT of core/gl/sort_short.glsl, fragments: for pixels that have few, whose passes are faster for it, and the most there may be. What is longer has
// states (Frame::makeStates).
inline constexpr std::uint32_t kFewFragments = 32, kShortArray = 128;
gl::Defines shortDefine(std::size_t most);   // of the two, the one for pixels of at most so many

// The method's `file` calls deliverArray(first, count) for each pixel in the passes RESOLVE, BEGIN, HEAP, POP and FINISH; `fragments` holds its array, no pixel
// has more than `most`. Uses buffer slot 7. Passes over the pixels: 1, and 4 + 3n/2048 more where a pixel has n > kShortArray fragments.
using Uniforms = std::vector<std::pair<const char*, GLuint>>;
void deliverArrays(gl::Frame& frame, const std::string& file, const gl::Buffer& fragments, std::size_t most,
                   const Uniforms& uniforms = {}, const gl::Defines& defines = {});

// Bytes that a buffer, read as texels of texelBytes, may grow to when the method may use memoryBytes (0: no limit) and needs others beside it.
std::size_t roomFor(std::uint64_t memoryBytes, std::size_t others, std::size_t texelBytes);

}  // namespace copeel
