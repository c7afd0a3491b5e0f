#include "core/uninitialized.h"

#include <new>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define COPEEL_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define COPEEL_SANITIZED 1
#endif
#endif

#ifndef COPEEL_SANITIZED
#include <tbb/scalable_allocator.h>
#endif

namespace copeel::parallel {

#ifndef COPEEL_SANITIZED
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
