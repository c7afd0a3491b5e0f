// A model to images, in one call; and images as bytes.
#pragma once

#include <cstring>
#include <string>

#include "apps/csg/render_csg.h"

namespace copeel::test {

struct Drawing {
  csg::Frame frame;
  Stats stats;
};

inline Drawing draw(const csg::Model& model, const View& view, csg::RenderOptions options = {}) {
  options.wantDepth = options.wantIds = true;
  csg::Renderer renderer(model, options);
  Drawing result;
  result.frame = renderer.draw(view);
  result.stats = renderer.stats();
  return result;
}

// Colour, depth and ids, byte for byte.
inline std::string bytesOf(const csg::Frame& frame) {
  std::string bytes;
  const auto append = [&](const auto& pixels) {
    bytes.append(reinterpret_cast<const char*>(pixels.data()), pixels.size() * sizeof(pixels[0]));
  };
  append(frame.color.pixels);
  append(frame.depth.pixels);
  append(frame.ids.pixels);
  return bytes;
}

// Pixels that differ in depth or id.
inline int differentPixels(const csg::Frame& a, const csg::Frame& b, bool ids = true) {
  int count = 0;
  for (std::size_t i = 0; i < a.depth.pixels.size(); ++i) {
    count += a.depth.pixels[i] != b.depth.pixels[i] || (ids && a.ids.pixels[i] != b.ids.pixels[i]);
  }
  return count;
}

}  // namespace copeel::test
