// What bun and bad share: buffers and passes around core/gl/bucket_pairs.glsl.
#pragma once

#include "core/gl/frame.h"

namespace copeel {

// Passes KEYS and IDS over the geometry and RESOLVE over the pixels, for K buckets. Bytes: 16 K a pixel.
void drawBucketPairs(gl::Frame& frame, const char* file, std::uint32_t k, const gl::Defines& defines);

}  // namespace copeel
