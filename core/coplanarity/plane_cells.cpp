// Cells are ten margins wide, so that most planes lie inside one; a table of four bits a slot tells which are met more than once.
#include "core/coplanarity/plane_cells.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <memory>
#include <utility>

#include "core/coplanarity/facets.h"
#include "core/parallel.h"

namespace copeel {
namespace {

constexpr double kCellPerMargin = 10;
constexpr double kLargestCell = 0.05;
constexpr double kSmallestCell = 1e-14;        // below the rounding of a normal; cells count to 1e14
constexpr std::size_t kSlotsPerPlace = 16;     // by chance, a fifth of lone places seem to be in reach
constexpr std::size_t kGrain = 4096;           // places, for parallel loops

// What is known of the cells of each hash. Bits are only ever set, so the outcome does not depend on the order.
class Table {
 public:
  Table(std::size_t places, std::uint64_t seed)
      : seed_(seed),
        wordCount_(std::bit_ceil(std::max<std::size_t>(places * kSlotsPerPlace / kSlotsPerWord, 1))),
        words_(std::make_unique<std::atomic<std::uint32_t>[]>(wordCount_)) {}

  enum Bits : std::uint32_t { kHome = 1, kShared = 2, kReached = 4 };   // home of a place, of two; near another place's home

  std::uint32_t at(std::uint64_t cell) const {
    const std::uint64_t slot = mixed(cell + seed_);
    return words_[wordOf(slot)].load(std::memory_order_relaxed) >> shiftOf(slot) & 15;
  }
  std::uint32_t set(std::uint64_t cell, std::uint32_t bits) {
    const std::uint64_t slot = mixed(cell + seed_);
    return words_[wordOf(slot)].fetch_or(bits << shiftOf(slot), std::memory_order_relaxed) >> shiftOf(slot) & 15;
  }

 private:
  static constexpr std::size_t kSlotsPerWord = 8;
  std::size_t wordOf(std::uint64_t slot) const { return slot >> 3 & (wordCount_ - 1); }
  static unsigned shiftOf(std::uint64_t slot) { return static_cast<unsigned>(slot & 7) * 4; }

  std::uint64_t seed_;
  std::size_t wordCount_;
  std::unique_ptr<std::atomic<std::uint32_t>[]> words_;
};

std::vector<std::uint32_t> look(const std::vector<PlaneCells::Place>& places, std::uint64_t seed) {
  Table table(places.size(), seed);
  parallelFor(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const std::uint64_t home = PlaneCells::homeOf(places[i]);
      if (table.set(home, Table::kHome) & Table::kHome) table.set(home, Table::kShared);
    }
  });
  // Whoever finds another's home is in reach, and so is the one found.
  std::vector<std::uint8_t> inReach(places.size());
  parallelFor(places.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i != end; ++i) {
      const std::uint64_t home = PlaneCells::homeOf(places[i]);
      bool found = table.at(home) & Table::kShared;
      PlaneCells::anyNear(places[i], [&](std::uint64_t cell) {
        if (cell != home && table.at(cell) & Table::kHome) table.set(cell, Table::kReached), found = true;
        return false;
      });
      inReach[i] = found;
    }
  });
  std::vector<std::uint32_t> result;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (inReach[i] || table.at(PlaneCells::homeOf(places[i])) & Table::kReached) result.push_back(static_cast<std::uint32_t>(i));
  }
  return result;
}

}  // namespace

PlaneCells::PlaneCells(double margin)
    : cell_(std::clamp(margin * kCellPerMargin, kSmallestCell, kLargestCell)), margin_(margin / cell_) {}

PlaneCells::Place PlaneCells::placeOf(const glm::dvec3& normal, double offset) const {
  const double at[4] = {normal.x / cell_, normal.y / cell_, normal.z / cell_, offset / cell_};
  std::uint64_t home = 0;
  Place flags = std::abs(turnOf(normal)) < margin_ * cell_ ? kMayTurn : 0;
  for (unsigned i = 0; i < 4; ++i) {
    // To the nearest whole number, ties to even: the same for a plane and its negative.
    constexpr double kRounder = 6755399441055744.0;   // 1.5 · 2^52
    const double whole = (at[i] + kRounder) - kRounder;
    home += static_cast<std::uint64_t>(static_cast<std::int64_t>(whole)) * kStep[i];
    const double inside = at[i] - whole;
    if (std::abs(inside) <= 0.5 - margin_) continue;
    flags |= Place{1} << i;
    if (!(inside > 0)) flags |= Place{16} << i;
  }
  return home << kFlagBits | flags;
}

std::vector<std::uint32_t> placesInReach(const std::vector<PlaneCells::Place>& places) {
  std::vector<std::uint32_t> inReach = look(places, 0);
  // Those that only seemed to be in reach mostly do so no more when hashed otherwise: look again while it helps.
  std::size_t before = places.size();
  for (std::uint64_t seed = 1; inReach.size() < before / 2; ++seed) {
    before = inReach.size();
    std::vector<PlaneCells::Place> again(before);
    for (std::size_t i = 0; i < before; ++i) again[i] = places[inReach[i]];
    std::vector<std::uint32_t> still = look(again, seed);
    for (std::uint32_t& i : still) i = inReach[i];
    inReach = std::move(still);
  }
  return inReach;
}

}  // namespace copeel
