// Points of a plane in square cells, about one point per cell, to find those in a box. Built once; points are not moved or removed.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/common.hpp>
#include <glm/vec2.hpp>

namespace copeel {

class PointGrid {
 public:
  // members: which of the points are entered.
  void build(const std::vector<glm::dvec2>& points, std::span<const std::uint32_t> members) {
    low_ = glm::dvec2(0);
    glm::dvec2 high(0);
    for (std::size_t i = 0; i < members.size(); ++i) {
      low_ = i == 0 ? points[members[i]] : glm::min(low_, points[members[i]]);
      high = i == 0 ? points[members[i]] : glm::max(high, points[members[i]]);
    }
    side_ = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(members.size()))));
    size_ = (high - low_) / static_cast<double>(side_);
    // Count, sum, fill from the end of each cell: afterwards start_[cell] is where the cell begins.
    start_.assign(static_cast<std::size_t>(side_) * side_ + 1, 0);
    for (const std::uint32_t member : members) ++start_[cellOf(points[member])];
    std::uint32_t sum = 0;
    for (std::uint32_t& start : start_) start = sum += start;
    members_.resize(members.size());
    for (const std::uint32_t member : members) members_[--start_[cellOf(points[member])]] = member;
  }

  // Whether test(member) is true for any member of the cells that the box touches.
  template <class Test>
  bool any(const glm::dvec2& low, const glm::dvec2& high, Test test) const {
    const int firstColumn = column(low.x, 0), lastColumn = column(high.x, 0), lastRow = column(high.y, 1);
    for (int row = column(low.y, 1); row <= lastRow; ++row) {
      const std::size_t cells = static_cast<std::size_t>(row) * side_;
      for (std::uint32_t i = start_[cells + firstColumn]; i < start_[cells + lastColumn + 1]; ++i) {
        if (test(members_[i])) return true;
      }
    }
    return false;
  }

 private:
  int column(double value, int axis) const {
    const double cell = size_[axis] > 0 ? (value - low_[axis]) / size_[axis] : 0.0;
    return static_cast<int>(std::clamp(cell, 0.0, side_ - 1.0));
  }
  std::size_t cellOf(const glm::dvec2& p) const {
    return static_cast<std::size_t>(column(p.y, 1)) * side_ + column(p.x, 0);
  }

  glm::dvec2 low_{0}, size_{0};
  int side_ = 1;
  std::vector<std::uint32_t> start_, members_;
};

}  // namespace copeel
