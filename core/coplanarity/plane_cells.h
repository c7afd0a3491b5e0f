// Cells of the space of planes (normal, offset): planes that may agree lie in one cell, or within a margin of their cell's border and so in
// two neighbours.
//
// A cell has a number that is linear in its four coordinates: a neighbour's is a sum away, and that of the same plane turned round is the
// negative. A place is 8 bytes: the number, and on which borders the plane lies.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

namespace copeel {

class PlaneCells {
 public:
  using Place = std::uint64_t;

  // margin: how far normals (and offsets, in diagonals) of planes that agree may lie apart.
  explicit PlaneCells(double margin);

  Place placeOf(const glm::dvec3& normal, double offset) const;

  static std::uint64_t homeOf(Place place) { return place >> kFlagBits; }

  // Calls visit(cell) for the home cell and then for all whose planes may agree, until it returns true; true where it did.
  template <class Visit>
  static bool anyNear(Place place, Visit visit) {
    return anyNear(place, homeOf(place), 1, visit) || (place & kMayTurn && anyNear(place, (0 - homeOf(place)) & kCellMask, ~std::uint64_t{0}, visit));
  }

 private:
  // Flags: bits 0-3, the coordinate is near a border; 4-7, near the lower one; 8, the sign of the normal is unsure.
  static constexpr int kFlagBits = 9;
  static constexpr Place kMayTurn = 256;
  static constexpr std::uint64_t kCellMask = ~std::uint64_t{0} >> kFlagBits;
  // Odd and random.
  static constexpr std::uint64_t kStep[4] = {0x9E3779B97F4A7C15u, 0xC2B2AE3D27D4EB4Fu, 0xD6E8FEB86659FD93u, 0x165667B19E3779F9u};

  template <class Visit>
  static bool anyNear(Place place, std::uint64_t home, std::uint64_t sign, Visit visit) {
    std::uint64_t steps[4];
    unsigned count = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if (place >> i & 1) steps[count++] = (place >> (i + 4) & 1 ? 0 - kStep[i] : kStep[i]) * sign;
    }
    for (unsigned corner = 0; corner < 1u << count; ++corner) {
      std::uint64_t cell = home;
      for (unsigned i = 0; i < count; ++i) cell += corner >> i & 1 ? steps[i] : 0;
      if (visit(cell & kCellMask)) return true;
    }
    return false;
  }

  double cell_, margin_;   // margin in cells
};

// The places that share a cell with the neighbourhood of another one, ascending; a few more by collisions of hashes. The others are alone: no
// other plane can agree with theirs. O(n), in parallel; 9 bytes a place.
std::vector<std::uint32_t> placesInReach(const std::vector<PlaneCells::Place>& places);

// Well-mixed bits of a cell's number.
inline std::uint64_t mixed(std::uint64_t cell) {
  cell *= 0x9E3779B97F4A7C15u;
  cell = (cell ^ cell >> 32) * 0xD6E8FEB86659FD93u;
  return cell ^ cell >> 32;
}

}  // namespace copeel
