#include "bench/machine.h"

#include <cstdlib>
#include <fstream>
#include <thread>

#include <hwy/targets.h>
#include <unistd.h>

namespace copeel::bench {
namespace {

std::string processorName() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

// Highway's own names say little to others: its targets number from best to least.
std::string simdName() {
  const std::int64_t targets = hwy::SupportedTargets();
  const std::int64_t best = targets & -targets;
#if HWY_ARCH_X86
  if (best < HWY_AVX2) return "AVX-512";
  if (best == HWY_AVX2) return "AVX2";
#endif
  return hwy::TargetName(best);
}

}  // namespace

Machine describeMachine() {
  Machine machine;
  machine.processor = processorName();
  machine.cores = std::thread::hardware_concurrency();
  machine.simd = simdName();
  machine.memoryBytes = static_cast<std::uint64_t>(sysconf(_SC_PHYS_PAGES)) * static_cast<std::uint64_t>(sysconf(_SC_PAGE_SIZE));
  machine.compiler = "g++ " __VERSION__;
  if (getloadavg(&machine.load, 1) != 1) machine.load = 0;
  return machine;
}

}  // namespace copeel::bench
