// What kb and k-plus share: buffers and passes around core/gl/k_buffer.glsl.
#pragma once

#include "core/gl/frame.h"
#include "core/methods/draw.h"

namespace copeel {

// Gathers the K nearest fragments by pass GATHER of `file` and delivers them by RESOLVE. `overflow` is what met a full buffer.
MethodCounts drawNearest(gl::Frame& frame, const MethodOptions& options, const char* file, const gl::Defines& defines = {});

}  // namespace copeel
