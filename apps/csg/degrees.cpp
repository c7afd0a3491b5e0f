#include "apps/csg/degrees.h"

#include <cmath>
#include <limits>

namespace copeel::csg {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kSqrtHalf = 0.70710678118654752440;
constexpr double kSqrtThreeQuarters = 0.86602540378443859659;   // one ulp below the nearest double, as openscad has it
constexpr double kHugeDegrees = 360.0 * 4503599627370496.0;      // 2^52 turns: no fraction of a turn is left in a double

// Sine of 0 … 90 degrees; each half of the range from the function that is accurate there.
double sinOfQuarter(double x) {
  if (x == 30.0) return 0.5;
  if (x == 45.0) return kSqrtHalf;
  if (x == 60.0) return kSqrtThreeQuarters;
  return x < 45.0 ? std::sin(x * kPi / 180.0) : std::cos((90.0 - x) * kPi / 180.0);
}

// 0 … 360; NaN for what is no angle.
double withinTurn(double x) {
  if (x >= 0.0 && x < 360.0) return x;
  if (!(std::abs(x) < kHugeDegrees)) return std::numeric_limits<double>::quiet_NaN();
  return x - 360.0 * std::floor(x / 360.0);
}

}  // namespace

double sinDegrees(double degrees) {
  double x = withinTurn(degrees);
  const bool opposite = x >= 180.0;
  if (opposite) x -= 180.0;
  if (x > 90.0) x = 180.0 - x;
  const double sine = sinOfQuarter(x);
  return opposite ? -sine : sine;
}

double cosDegrees(double degrees) {
  double x = withinTurn(degrees);
  bool opposite = x >= 180.0;
  if (opposite) x -= 180.0;
  if (x > 90.0) {
    x = 180.0 - x;
    opposite = !opposite;
  }
  double cosine;
  if (x == 30.0) {
    cosine = kSqrtThreeQuarters;
  } else if (x == 45.0) {
    cosine = kSqrtHalf;
  } else if (x == 60.0) {
    cosine = 0.5;
  } else {
    cosine = x > 45.0 ? std::sin((90.0 - x) * kPi / 180.0) : std::cos(x * kPi / 180.0);
  }
  return opposite ? -cosine : cosine;
}

}  // namespace copeel::csg
