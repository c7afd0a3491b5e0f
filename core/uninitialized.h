// An array that leaves new elements as the memory is: for what is written right after, in parallel. Not a std::vector with another allocator:
// that visits all elements to destroy them, and below -O2 g++ keeps the empty loop. Memory comes from oneTBB's allocator, which keeps what was
// given back for the next frame: fetched anew from the system, its pages are a sixth of the time of a frame of 69,000 triangles.
#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>

namespace copeel {

namespace memory {
void* take(std::size_t bytes);   // aligned for all types of C++'s own; throws std::bad_alloc
void giveBack(void* taken) noexcept;
}  // namespace memory

template <class T>
class UninitializedVector {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T> && alignof(T) <= alignof(std::max_align_t));

 public:
  UninitializedVector() = default;
  explicit UninitializedVector(std::size_t size) : elements_(take(size)), size_(size) {}
  explicit UninitializedVector(std::size_t size, const T& value) : UninitializedVector(size) { std::fill_n(data(), size, value); }
  UninitializedVector(const UninitializedVector& other) : UninitializedVector(other.size_) { std::copy_n(other.data(), size_, data()); }
  UninitializedVector(UninitializedVector&& other) noexcept { swap(other); }
  UninitializedVector& operator=(UninitializedVector other) noexcept {
    swap(other);
    return *this;
  }
  void swap(UninitializedVector& other) noexcept {
    elements_.swap(other.elements_);
    std::swap(size_, other.size_);
  }

  T* data() { return elements_.get(); }
  const T* data() const { return elements_.get(); }
  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }
  const T* begin() const { return data(); }
  const T* end() const { return data() + size_; }
  T& operator[](std::size_t i) { return elements_[i]; }
  const T& operator[](std::size_t i) const { return elements_[i]; }
  friend bool operator==(const UninitializedVector& a, const UninitializedVector& b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); }

 private:
  struct Give {
    void operator()(T* elements) const noexcept { memory::giveBack(elements); }
  };
  static T* take(std::size_t size) {
    if (size > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_array_new_length();
    return static_cast<T*>(memory::take(size * sizeof(T)));
  }

  std::unique_ptr<T[], Give> elements_;
  std::size_t size_ = 0;
};

}  // namespace copeel
