// What our methods have to beat: a linked list a pixel as the textbook has it.
#pragma once

#include "core/methods/draw.h"

namespace copeel::bench {

// Delivers to the results of the fold of transparency alone, not through the fold's states. Loses what lies beyond 128 fragments of a pixel, and
// fragments that a guess of options.k a pixel has no room for (`overflow`).
MethodCounts drawPlainList(gl::Frame& frame, const MethodOptions& options);

}  // namespace copeel::bench
