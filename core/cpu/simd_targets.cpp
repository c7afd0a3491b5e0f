// Which of Highway's targets this processor has, so that Highway is used as headers alone.
//
// These are the functions that its dispatch macros call, as its headers declare them. Its own library would define them too, but that library
// measures the clock when it is loaded, 3 ms before every main(), for timers that we do not use. GCC and clang know the processor already.
#include <hwy/targets.h>

#if HWY_ARCH_X86
#include <cpuid.h>
#endif

namespace hwy {
namespace {

std::int64_t disabledTargets = 0;

// What the compiler may emit for a target (ops/set_macros-inl.h) must all be there; the builtin asks the operating system, too, whether it
// keeps the wide registers.
std::int64_t detectedTargets() {
  std::int64_t targets = HWY_STATIC_TARGET | HWY_SCALAR | HWY_EMU128;
#if HWY_ARCH_X86
  const bool ssse3 = __builtin_cpu_supports("ssse3");
  const bool sse4 = ssse3 && __builtin_cpu_supports("sse4.1") && __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") &&
                    __builtin_cpu_supports("aes");
  // F16C and LZCNT have no name that all compilers know here.
  unsigned a = 0, b = 0, c = 0, d = 0;
  const bool f16c = __get_cpuid(1, &a, &b, &c, &d) && (c & bit_F16C);
  const bool lzcnt = __get_cpuid(0x80000001u, &a, &b, &c, &d) && (c & bit_ABM);
  const bool avx2 = sse4 && f16c && lzcnt && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
                    __builtin_cpu_supports("bmi") && __builtin_cpu_supports("bmi2");
  const bool avx3 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
                    __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd");
  targets |= (ssse3 ? HWY_SSSE3 : 0) | (sse4 ? HWY_SSE4 : 0) | (avx2 ? HWY_AVX2 : 0) | (avx3 ? HWY_AVX3 : 0);
#endif
  return targets;
}

}  // namespace

std::int64_t SupportedTargets() {
  const std::int64_t targets = detectedTargets() & ~disabledTargets;
  return targets ? targets : HWY_STATIC_TARGET;
}

// The next dispatch asks again.
void DisableTargets(std::int64_t targets) {
  disabledTargets = targets;
  GetChosenTarget().DeInit();
}

ChosenTarget& GetChosenTarget() {
  static ChosenTarget chosen;
  return chosen;
}

}  // namespace hwy
