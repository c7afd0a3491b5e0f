// The modifier +occupancy, one facility for all methods that keep the nearest fragments.
#pragma once

#include "core/gl/frame.h"
#include "core/methods/draw.h"

namespace copeel {

// Draws the maps when the options want them, and returns the defines that make a gather pass with core/gl/occupancy.glsl obey them (else none).
// Uses buffer slots 5 and 6.
gl::Defines drawOccupancy(gl::Frame& frame, const MethodOptions& options);

}  // namespace copeel
