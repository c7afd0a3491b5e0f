// Random scenes in all placements from three views each: the renderer against CGAL's exact Booleans and against the oracle of exact crossings, and these two
// against each other. Fails the running test for every scene with a wrong off-edge pixel and prints the sums.
#pragma once

#include <cstdint>

namespace copeel::validation {

// `count` solids that are not empty, from seeds `first` on; four scenes each.
void sweepScenes(std::uint64_t first, int count, int maxLeafCount, int width, int height);

}  // namespace copeel::validation
