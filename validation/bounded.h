// A double with a proven bound of its rounding error, and the exact rationals behind it. The oracle's formulas are templates over both:
// they are evaluated as Bounded first and as mpq_class only where the bound leaves the question open.
// Based on: forward error analysis as in Higham, Accuracy and Stability of Numerical Algorithms, 2002, section 2.2.
// Needs: round to nearest, no fused multiply-add (-ffp-contract=off), values far from overflow.
#pragma once

#include <cmath>
#include <limits>
#include <optional>

#include <gmpxx.h>

namespace copeel::validation {

// The true value lies in [value - error, value + error].
struct Bounded {
  double value = 0;
  double error = 0;

  Bounded() = default;
  Bounded(double v) : value(v) {}   // NOLINT: a double is itself, without error
  Bounded(double v, double e) : value(v), error(e) {}
};

namespace detail {
inline constexpr double kHalfUlp = 0x1p-53;             // relative error of one rounding
inline constexpr double kRoundUp = 1.0 + 0x1p-48;       // covers the few roundings within an error's own formula
inline constexpr double kUnderflow = 0x1p-1060;         // absolute error of a product that becomes denormal
}  // namespace detail

inline Bounded operator-(const Bounded& a) { return {-a.value, a.error}; }

inline Bounded operator+(const Bounded& a, const Bounded& b) {
  const double v = a.value + b.value;
  return {v, (a.error + b.error + std::abs(v) * detail::kHalfUlp) * detail::kRoundUp};
}

inline Bounded operator-(const Bounded& a, const Bounded& b) { return a + (-b); }

inline Bounded operator*(const Bounded& a, const Bounded& b) {
  const double v = a.value * b.value;
  const double e = std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error + std::abs(v) * detail::kHalfUlp;
  return {v, e * detail::kRoundUp + detail::kUnderflow};
}

// A divisor that may be zero gives an unbounded error: every later question is then asked of the rationals.
inline Bounded operator/(const Bounded& a, const Bounded& b) {
  const double least = std::abs(b.value) - b.error;
  if (!(least > 0)) return {0.0, std::numeric_limits<double>::infinity()};
  const double v = a.value / b.value;
  const double e = (a.error + std::abs(v) * b.error) / least + std::abs(v) * detail::kHalfUlp;
  return {v, e * detail::kRoundUp + detail::kUnderflow};
}

// -1, 0, 1, or nothing when the bound does not tell.
inline std::optional<int> signOf(const Bounded& a) {
  if (a.value > a.error) return 1;
  if (-a.value > a.error) return -1;
  if (a.error == 0) return 0;
  return std::nullopt;
}

inline std::optional<int> signOf(const mpq_class& a) { return sgn(a); }

// The nearest doubles of rationals, for the filter.
inline Bounded boundedOf(const mpq_class& a) {
  const double v = a.get_d();   // truncates: the error is below one unit in the last place
  return mpq_class(v) == a ? Bounded(v) : Bounded(v, std::abs(v) * 0x1p-52 + detail::kUnderflow);
}

}  // namespace copeel::validation
