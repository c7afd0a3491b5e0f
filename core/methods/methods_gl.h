// The draw functions of the methods of the gl back end, one line each, for the registry.
#pragma once

#include "core/methods/draw.h"

namespace copeel {

MethodCounts drawF2b(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2b2(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2bZf(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2bKbZf(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2b2p(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2b3p(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2bLl(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2bFab(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawF2bKb(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawHybrid(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawDual(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawDual2p(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawDualLl(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawDualFab(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawDualKb(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawAuto(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawFab(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawLl(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawSb(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawKb(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawKPlus(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawBunLl(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawSrab(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawMultiKb(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawBun(gl::Frame& frame, const MethodOptions& options);
MethodCounts drawBad(gl::Frame& frame, const MethodOptions& options);

}  // namespace copeel
