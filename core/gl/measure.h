// What a method delivers of a scene, counted on the device apart from the frames that are timed.
#pragma once

#include "core/gl/renderer.h"
#include "core/metrics/stats.h"

namespace copeel::gl {

// Fills fragments, fragmentsCaptured, depthComplexityMax, coveredPixels, coplanarPixels and uncertain of the view that is set. Takes the place of the renderer's fold.
void measure(Renderer& renderer, const MethodInfo& method, const MethodOptions& options, Stats& stats);

}  // namespace copeel::gl
