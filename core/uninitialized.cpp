#include "core/uninitialized.h"

#include <new>

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
#include <tbb/scalable_allocator.h>
#define COPEEL_KEEPS_MEMORY 1
#endif

namespace copeel::parallel {

#ifdef COPEEL_KEEPS_MEMORY
void* takeMemory(std::size_t bytes) {
  void* const memory = scalable_malloc(bytes);
  if (!memory) throw std::bad_alloc();
  return memory;
}

void giveMemory(void* memory) noexcept { scalable_free(memory); }
#else
// What is checked by a sanitizer comes from its own allocator.
void* takeMemory(std::size_t bytes) { return ::operator new(bytes); }
void giveMemory(void* memory) noexcept { ::operator delete(memory); }
#endif

}  // namespace copeel::parallel
