// glibc's allocator by mallopt; elsewhere nothing is done. The reserve is address space: only what is used becomes memory.
#include "apps/copeel/heap.h"

#include <cstdint>
#include <cstdlib>

#ifdef __GLIBC__
#include <malloc.h>
#include <sys/mman.h>
#include <unistd.h>
#endif

namespace copeel {

void keepHeap() {
#ifdef __GLIBC__
  constexpr int kLargestBlockBytes = 32 << 20;                 // the most that mallopt takes; a larger block is mapped by itself
  constexpr int kNever = 1 << 30;                              // bytes: nothing is given back
  constexpr int kReserveBytes = 128 << 20;
  constexpr std::uintptr_t kLargePageBytes = 2 << 20;
  mallopt(M_MMAP_THRESHOLD, kLargestBlockBytes);
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_ARENA_MAX, 1);   // the others could not grow to such blocks
  // The top of the heap grows by the reserve at the next block that does not fit.
  mallopt(M_TOP_PAD, kReserveBytes);
  const auto before = reinterpret_cast<std::uintptr_t>(sbrk(0));
  void* volatile block = std::malloc(kLargePageBytes);   // volatile, as a compiler may leave out what is only given back
  std::free(block);
  const auto after = reinterpret_cast<std::uintptr_t>(sbrk(0));
  const std::uintptr_t first = (before + kLargePageBytes - 1) / kLargePageBytes * kLargePageBytes;
  if (first < after) madvise(reinterpret_cast<void*>(first), after - first, MADV_HUGEPAGE);
#endif
}

}  // namespace copeel
