// An image of one value. Written in parallel: a frame of a small model takes no longer than such a fill by one thread.
#pragma once

#include <algorithm>
#include <cstddef>

#include "core/image/image.h"
#include "core/parallel.h"

namespace copeel {

template <class T>
Image<T> filled(int width, int height, const T& value) {
  Image<T> image = Image<T>::uninitialized(width, height);
  parallelFor(image.pixels.size(), 1 << 16, [&](std::size_t begin, std::size_t end) {
    // Doubling copies are faster than a loop over values of three bytes.
    T* const first = image.pixels.data() + begin;
    *first = value;
    for (std::size_t done = 1, count = end - begin; done < count; done *= 2) std::copy_n(first, std::min(done, count - done), first + done);
  });
  return image;
}

}  // namespace copeel
