// A CSG model as a forest of threshold gates, and its part that matters in one tile.
//
// Every operation is a gate that is true when at least `threshold` of its inputs are: a union needs one, an intersection all; a difference is
// an intersection whose later inputs are negated. Toggling a leaf then costs a walk up to the first gate that does not change, and an input
// that is constant in a tile just disappears from it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "apps/csg/csg_model.h"

namespace copeel::csg {

inline constexpr std::uint32_t kNone = ~std::uint32_t{0};

struct Gate {
  std::uint32_t parent = kNone;
  bool negated = false;          // seen by the parent
  bool all = false;              // an intersection: every positive input must be there
  std::uint32_t positiveInputs = 0;
  std::uint32_t output = kNone;  // index of the result it is, if any
};

struct LeafUse {
  std::uint32_t gate;
  bool negated;
};

// A result that is looked at: a part as a whole, or its opaque share (its translucent leaves that add taken as empty).
struct Output {
  std::uint32_t gate;
  std::uint32_t part;            // 0 the solid, then the backgrounds, then the highlights
  bool opaqueShare;
};

struct GateForest {
  std::vector<Gate> gates;       // children before parents
  std::vector<Output> outputs;   // overlays before the solid, so that a highlight lies in front of what it marks
  std::vector<std::uint32_t> firstUse;   // per leaf, and the end
  std::vector<LeafUse> uses;
  std::vector<std::uint8_t> cuts;        // per leaf: it is subtracted (an odd number of times) in the solid
  std::uint32_t firstSection = kNone;    // leaves from here on are sections
};

// `sections`: leaves (indices after the model's own) subtracted from the solid. `translucent`: per leaf, whether it is seen through.
GateForest buildGates(const Model& model, std::span<const std::uint32_t> sections, const std::vector<std::uint8_t>& translucent,
                      std::uint32_t leafCount);

// The forest restricted to some leaves, all others being constantly outside.
class PrunedForest {
 public:
  struct Node {
    std::uint32_t parent;        // kNone: feeds an output
    std::int32_t threshold;
    std::int32_t initial;        // inputs true while all leaves are outside
    std::uint32_t output;        // or kNone
    bool negated;                // seen by the parent
  };
  struct Use {
    std::uint32_t node;
    bool negated;
  };

  // O(gates above the leaves). `leaves` ascending.
  void prune(const GateForest& forest, std::span<const std::uint32_t> leaves);

  std::span<const Node> nodes() const { return nodes_; }
  std::span<const Use> uses(std::uint32_t localLeaf) const {
    return {uses_.data() + firstUse_[localLeaf], firstUse_[localLeaf + 1] - firstUse_[localLeaf]};
  }
  // How many leaves must be entered at least before any output is true.
  double leastEntries() const { return leastEntries_; }
  bool matters(std::uint32_t localLeaf) const { return firstUse_[localLeaf] != firstUse_[localLeaf + 1]; }

 private:
  struct Live {
    std::uint32_t epoch = 0;
    std::uint32_t positive = 0;      // live inputs
    std::uint32_t negative = 0;      // live negated inputs
    bool possible = false;           // can become true in the tile
    std::uint32_t node = kNone;      // its number in nodes_, or that of the gate it passes its only input on to
    bool inverts = false;            // an input passed on arrives negated
  };
  void markAncestors(const GateForest& forest, std::span<const std::uint32_t> leaves);
  void settleGates(const GateForest& forest);
  void numberGates(const GateForest& forest);
  void countLeastEntries();

  std::vector<Live> live_;
  std::vector<std::uint32_t> marked_;
  std::uint32_t epoch_ = 0;
  std::vector<Node> nodes_;
  std::vector<Use> uses_;
  std::vector<std::uint32_t> firstUse_;
  std::vector<double> entries_;
  double leastEntries_ = 0;
};

}  // namespace copeel::csg
