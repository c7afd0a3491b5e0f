// The order of the fragments in a block of 8×8 pixels, vectorised with run-time dispatch: whole numbers only, so every target gives the same.
#pragma once

#include <cstdint>

#include "core/cpu/kernels.h"

namespace copeel::cpu {

class Tile;

// Sorts each pixel's fragments of a block, front to back.
void sortBlock(const FragmentBlock& block);

// True where all pixels of a sorted block certainly meet the same slots in the same order, as inside large faces.
bool sameStacks(const FragmentBlock& block, const Tile& tile);

}  // namespace copeel::cpu
