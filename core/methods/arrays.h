// Delivery of fragments that a method gathered into contiguous arrays: the passes of core/gl/sort_array.glsl.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "core/gl/frame.h"

namespace copeel {

inline constexpr std::uint32_t kShortArray = 128;   // fragments; longer ones have states (Frame::makeStates). SORT_SHORT of sort_short.glsl

// The method's `file` calls deliverArray(first, count) for each pixel in the passes RESOLVE, BEGIN, HEAP, POP and FINISH; `fragments` holds its array, no pixel
// has more than `most`. Uses buffer slot 7. Passes over the pixels: 1, and 4 + 3n/2048 more where a pixel has n > kShortArray fragments.
using Uniforms = std::vector<std::pair<const char*, GLuint>>;
void deliverArrays(gl::Frame& frame, const std::string& file, const gl::Buffer& fragments, std::size_t most,
                   const Uniforms& uniforms = {}, const gl::Defines& defines = {});

// Bytes that a buffer, read as texels of texelBytes, may grow to when the method may use memoryBytes (0: no limit) and needs others beside it.
std::size_t roomFor(std::uint64_t memoryBytes, std::size_t others, std::size_t texelBytes);

}  // namespace copeel
