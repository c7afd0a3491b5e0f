// One comparison for all: a depth image (and an image of leaves) against the exact answer, edge pixels counted apart.
//
// An edge pixel has its centre within the rasterizer's sub-pixel step, 1/256 pixel, of a projected edge: of a leaf or of the result's creases
// (found from the answers of eight rays one step away), so that snapped vertices may rightly show what lies beyond.
// A pixel touches a silhouette or crease when a neighbour to the right or below shows another plane.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image/image.h"
#include "validation/oracle.h"

namespace copeel::validation {

inline constexpr double kSubPixelStep = 1.0 / 256;

struct WrongPixel {
  int x = 0, y = 0;
  double depth = 0, expected = 0;   // +inf: nothing
  int leaf = -1, expectedLeaf = -1; // -1: nothing, or not asked
  bool edge = false;
};

struct Comparison {
  std::uint64_t pixels = 0;
  std::uint64_t covered = 0;          // by the exact answer
  std::uint64_t touched = 0;          // pixels that a silhouette or crease touches
  std::uint64_t wrongOffEdge = 0;
  std::uint64_t wrongEdge = 0;
  std::uint64_t wrongLeafOffEdge = 0; // right depth, wrong leaf
  double greatestError = 0;           // of right pixels, model units
  std::vector<WrongPixel> samples;    // the first few wrong ones

  void add(const Comparison& other);
  std::string summary() const;
};

// Which edges make edge pixels: those of the leaves too (the caster of the model's leaves), beside the creases of the answer.
Comparison compareDepth(const Image<float>& depth, const Oracle& oracle, const RayCaster& leaves, const Image<std::uint16_t>* ids = nullptr);

// The exact depth image of an oracle, +inf where nothing is seen, for use as a file or a picture.
Image<float> depthImage(const Oracle& oracle);

// How far a float32 depth may be from the exact one: its rounding, and the declared tolerance (ten times over) along the ray.
double allowedError(const Oracle& oracle, const Ray& ray, const Seen& expected);

// Two oracles of one scene must agree: the depths of one as an image against the other.
Comparison compareOracles(const Oracle& tested, const Oracle& truth, const RayCaster& leaves);

}  // namespace copeel::validation
