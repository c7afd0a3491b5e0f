// What a run can say of the project's goals: each figure beside the limit that it is held to. Reported, never a reason to fail: the machine may be busy.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace copeel::bench {

struct Report;

struct Limit {
  std::string subject, what;
  double value = 0, limit = 0;
  bool atLeast = false;       // a least, not a most
  bool holds() const { return atLeast ? value >= limit : value <= limit; }
};

// Of the speed part: tile's ms with so many bunnies, and its time to the plain z-buffer's.
double mostMsOf(std::size_t copyCount);
double mostRatioOf(bool hairball);

std::vector<Limit> limitsOf(const Report& report);

// "12 of 13 limits hold.", and the others, each as a line.
std::string toText(const std::vector<Limit>& limits);

}  // namespace copeel::bench
