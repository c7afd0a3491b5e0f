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

namespace copeel::memory {

#ifndef COPEEL_SANITIZED
void* take(std::size_t bytes) {
  void* const taken = scalable_malloc(bytes);
  if (!taken) throw std::bad_alloc();
  return taken;
}

void giveBack(void* taken) noexcept { scalable_free(taken); }
#else
// What is checked by a sanitizer comes from its own allocator.
void* take(std::size_t bytes) { return ::operator new(bytes); }
void giveBack(void* taken) noexcept { ::operator delete(taken); }
#endif

}  // namespace copeel::memory
