// What a view of a scene asks of a method: the depths of its pixels, and how many fragments lie at each, counted by the cpu back end; and what the methods'
// formulas make of that. Symbols as in `copeel methods`: D depths, N fragments, C(Z) of them at one depth, K the buffer's length.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "apps/oit/render_oit.h"

namespace copeel::bench {

using Groups = std::vector<std::uint32_t>;   // of a pixel: fragments at each depth, front to back

struct Shape {
  std::uint64_t pixels = 0, coveredPixels = 0, coplanarPixels = 0;
  std::uint64_t fragments = 0, depths = 0;   // of all pixels together
  std::vector<Groups> fullest;               // the pixels with most depths, most fragments, most pairs of coplanar ones

  std::uint64_t most(std::uint64_t (*value)(const Groups&)) const;
  double cp() const { return coveredPixels ? double(coplanarPixels) / double(coveredPixels) : 0; }
};

Shape shapeOf(const std::vector<oit::Part>& parts, const View& view, int threads);

// By the formulas; where they say "at most" or "about", that; where a buffer grows, without the repeats.
double expectedPasses(std::string_view method, const Shape& shape, std::uint32_t k);

// Of a scene whose covered pixels are all alike. Negative where the formula says less than a number.
double expectedBytes(std::string_view method, const Shape& shape, std::uint32_t k);
double expectedRh(std::string_view method, const Shape& shape, std::uint32_t k);

}  // namespace copeel::bench
