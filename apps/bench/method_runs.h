// Methods as they are asked for: with modifiers, buffer length and source of depth.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/methods/method.h"

namespace copeel::bench {

struct MethodRun {
  const MethodInfo* method;
  MethodOptions options;
  std::string label;                     // as on the command line, and what sets it apart in a report
};

// The runs that a name on the command line means, on the back ends that `backend` (cpu, gl, auto: both) admits. Throws Error{Usage} as chooseMethod() does.
std::vector<MethodRun> runsOf(std::string_view backend, std::string_view text, std::uint32_t k);

// Every method of this build that runs there.
std::vector<MethodRun> allRuns(std::string_view backend, std::uint32_t k);

// Those of `names` that this build has on these back ends; others are passed over.
std::vector<MethodRun> runsThatAre(const std::vector<std::string>& names, std::string_view backend, std::uint32_t k);

// The same of the gl back end with the rasterizer's depth, as the papers take it.
std::vector<MethodRun> withHardwareDepth(const std::vector<MethodRun>& runs);

void append(std::vector<MethodRun>& all, const std::vector<MethodRun>& some);

}  // namespace copeel::bench
