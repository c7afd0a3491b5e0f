// What ll and bun-ll share: buffers and passes around core/gl/lists.glsl.
#pragma once

#include "core/gl/frame.h"
#include "core/methods/draw.h"

namespace copeel {

// Gathers into `lists` lists a pixel, each with `parts` memories, by pass GATHER of `file`, grows all to what the fullest asked for and repeats while it is too small,
// and delivers the lists, front one first. Bytes: 4 lists a pixel + 12 a node + 64 a memory + 4. Throws Error{Machine} for a list of more than 20,000 fragments
// (core/gl/lists.glsl).
MethodCounts drawLists(gl::Frame& frame, const MethodOptions& options, const char* file, std::uint32_t lists, std::uint32_t parts);

}  // namespace copeel
