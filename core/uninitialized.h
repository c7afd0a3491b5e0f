// A vector that leaves new elements as the memory is, where their type lets it: for what is written right after, in parallel.
#pragma once

#include <memory>
#include <new>
#include <utility>
#include <vector>

namespace copeel {

template <class T>
struct LeavesUninitialized : std::allocator<T> {
  LeavesUninitialized() = default;
  template <class U>
  LeavesUninitialized(const LeavesUninitialized<U>&) noexcept {}
  template <class U>
  struct rebind {
    using other = LeavesUninitialized<U>;
  };
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    if constexpr (sizeof...(Arguments) == 0) ::new (static_cast<void*>(at)) U;
    else ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};

template <class T>
using UninitializedVector = std::vector<T, LeavesUninitialized<T>>;

}  // namespace copeel
