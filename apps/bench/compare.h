// One frame against the reference: wrong pixels, noise, depth error, and the map that shows where.
//
// Back ends may differ in coverage within a rasterizer's sub-pixel step of a projected edge: those pixels are left out, and counted apart.
#pragma once

#include <cstdint>
#include <vector>

#include "apps/oit/render_oit.h"

namespace copeel::bench {

struct FrameError {
  std::uint64_t compared = 0;      // off-edge pixels that the reference or the frame covers
  std::uint64_t wrong = 0;         // of them: some channel off by more than half a level of 255
  std::uint64_t wrongOnEdges = 0;
  double psnr = 0;                 // dB over all off-edge pixels, peak 255; +inf where nothing differs
  double depth = 0;                // greatest difference, model units; +inf where one sees something and the other nothing

  double wrongShare() const { return compared ? double(wrong) / double(compared) : 0; }
};

// Per pixel: 1 where its centre lies within 1/256 pixel of a projected edge of a triangle.
std::vector<std::uint8_t> edgePixels(const std::vector<oit::Part>& parts, const View& view);

FrameError compare(const oit::Frame& frame, const oit::Frame& reference, const std::vector<std::uint8_t>& onEdge);

// Grey where right, from yellow (half a level) to red (64 levels and more) where wrong, blue on edges that differ.
Image<Rgb8> errorMap(const oit::Frame& frame, const oit::Frame& reference, const std::vector<std::uint8_t>& onEdge);

}  // namespace copeel::bench
