// The order of the fragments in a block of 8×8 pixels, vectorised with run-time dispatch: whole numbers only, so every target gives the same.
#pragma once

#include <cstdint>

#include "core/cpu/kernels.h"

namespace copeel::cpu {

class Tile;

// Sorts each pixel's fragments of a block, front to back.
void sortBlock(const FragmentBlock& block);

// What the keys of a sorted block tell of its pixels that have fragments, a bit each.
struct BlockOrder {
  std::uint64_t certain = 0;   // fragments whose depths are not certainly apart are of one plane class: coplanar
  std::uint64_t coplanar = 0;  // certain, and some are
  std::uint64_t repeats = 0;   // certain, the one before it in the row too, and both meet the same slots

  BlockOrder without(std::uint64_t pixels) const { return {certain & ~pixels, coplanar & ~pixels, repeats & ~(pixels | pixels << 1)}; }
};
BlockOrder orderOfBlock(const FragmentBlock& block, const Tile& tile);

// True where all pixels of a sorted block certainly meet the same slots in the same order, as inside large faces.
bool sameStacks(const FragmentBlock& block, const Tile& tile);

}  // namespace copeel::cpu
