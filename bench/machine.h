// What the figures were measured on, so far as a reader needs it to place them.
#pragma once

#include <cstdint>
#include <string>

namespace copeel::bench {

struct Machine {
  std::string processor;            // as its maker names it
  unsigned cores = 0;               // that this program may use
  std::string simd;                 // the widest target that the renderer takes here
  std::uint64_t memoryBytes = 0;
  std::string compiler;
  double load = 0;                  // runnable tasks in the minute before; well above 0 means the figures are noisy
};

Machine describeMachine();

}  // namespace copeel::bench
