// The time that a part of the bench may take.
#pragma once

#include <chrono>
#include <limits>

namespace copeel::bench {

class Deadline {
 public:
  Deadline() = default;   // never
  explicit Deadline(double ms) : budgetMs_(ms) {}

  double passedMs() const { return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count(); }
  double leftMs() const { return budgetMs_ - passedMs(); }
  void extend(double ms) { budgetMs_ += ms; }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  double budgetMs_ = std::numeric_limits<double>::infinity();
};

}  // namespace copeel::bench
