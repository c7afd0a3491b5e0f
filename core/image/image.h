// Images in memory, upper left pixel first, rows without padding.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <glm/vec3.hpp>

#include "core/uninitialized.h"

namespace copeel {

// Columns x … x + width - 1 of rows y … y + height - 1.
struct PixelRect {
  int x, y, width, height;
  bool empty() const { return width <= 0 || height <= 0; }
};

inline bool contains(const PixelRect& outer, const PixelRect& inner) {
  const bool across = inner.x >= outer.x && inner.x + inner.width <= outer.x + outer.width;
  return inner.empty() || (across && inner.y >= outer.y && inner.y + inner.height <= outer.y + outer.height);
}

inline PixelRect intersection(const PixelRect& a, const PixelRect& b) {
  const int x = std::max(a.x, b.x), y = std::max(a.y, b.y);
  return {x, y, std::max(0, std::min(a.x + a.width, b.x + b.width) - x), std::max(0, std::min(a.y + a.height, b.y + b.height) - y)};
}

template <class Visit>
void forEachOf(const PixelRect& rect, Visit visit) {
  for (int y = rect.y; y < rect.y + rect.height; ++y) {
    for (int x = rect.x; x < rect.x + rect.width; ++x) visit(x, y);
  }
}

template <class T>
struct Image {
  int width = 0;
  int height = 0;
  UninitializedVector<T> pixels;

  Image() = default;
  Image(int w, int h, T fill = T{}) : width(w), height(h), pixels(static_cast<std::size_t>(w) * h, fill) {}
  // To be written whole.
  static Image uninitialized(int w, int h) {
    Image image;
    image.width = w, image.height = h;
    image.pixels = UninitializedVector<T>(static_cast<std::size_t>(w) * h);
    return image;
  }
  void fill(const PixelRect& rect, const T& value) {
    T* const first = &at(rect.x, rect.y);
    std::fill_n(first, rect.width, value);
    for (int row = 1; row < rect.height; ++row) std::copy_n(first, rect.width, first + static_cast<std::size_t>(row) * width);
  }
  T& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const T& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

struct Rgb8 {
  std::uint8_t r, g, b;
  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};

// Channels 0 … 255 to the nearest whole number.
inline Rgb8 toRgb8(const glm::dvec3& color) {
  const auto byte = [](double v) { return static_cast<std::uint8_t>(std::clamp(v, 0.0, 255.0) + 0.5); };
  return {byte(color.r), byte(color.g), byte(color.b)};
}

}  // namespace copeel
