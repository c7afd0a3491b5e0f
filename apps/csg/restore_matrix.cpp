#include "apps/csg/restore_matrix.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include "apps/csg/degrees.h"

namespace copeel::csg {
namespace {

constexpr int kDigits = 6;                    // what openscad 2021.01 writes
constexpr double kHalfUnit = 0.5000001;       // of the last digit; a little more than half, for the rounding of this very comparison
constexpr double kZero = 1e-15;               // openscad writes 0 or a rounding residue of this size
constexpr double kNearlyRotation = 8;         // times the error of an entry: what three of them leave in a product of two rows
constexpr double kDegreesPerRadian = 57.29577951308232;
constexpr double kAngleTolerance = 1.6;       // times the error of an entry, which is the larger side of √2 such errors across a radius
constexpr double kMostAngleTolerance = 0.01;   // degrees: where angles are told apart badly, still none but near ones are tried
constexpr std::size_t kMaxAngles = 6;         // tried for each of the three
constexpr int kMaxTurnParts = 360;            // fractions p/q of a turn up to this q
constexpr int kMaxAxisEntry = 12;             // axes of whole numbers up to this

// 10^(floor(log10 |x|) - 5): the place of the sixth digit.
double sixthPlace(double x) { return std::pow(10.0, std::floor(std::log10(std::abs(x))) - (kDigits - 1)); }

bool printsAs(double candidate, double written) {
  const double difference = std::abs(candidate - written);
  return difference <= kZero || (written != 0 && difference <= kHalfUnit * sixthPlace(written));
}

bool printsAs(const glm::dmat3& candidate, const glm::dmat3& written) {
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (!printsAs(candidate[c][r], written[c][r])) return false;
    }
  }
  return true;
}

// Zeros as written are zeros: what rounding left of them would tilt faces that are parallel to an axis.
glm::dmat3 withZeros(glm::dmat3 candidate, const glm::dmat3& written) {
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (written[c][r] == 0) candidate[c][r] = 0;
    }
  }
  return candidate;
}

// The angles people write, no farther away than the tolerance: the roundest first.
std::vector<double> roundAngles(double degrees, double tolerance) {
  std::vector<double> angles;
  const auto add = [&](double angle) {
    const bool near = std::abs(angle - degrees) <= tolerance && angles.size() < kMaxAngles;
    if (near && std::find(angles.begin(), angles.end(), angle) == angles.end()) angles.push_back(angle);
  };
  for (const double perDegree : {1.0, 2.0, 4.0, 10.0, 20.0, 100.0}) add(std::round(degrees * perDegree) / perDegree);
  for (int q = 7; q <= kMaxTurnParts; ++q) add(std::round(degrees * q / 360) * 360 / q);
  add(std::round(degrees * 1000) / 1000);
  return angles;
}

// openscad's rotate([a, b, c]): about x, then y, then z.
glm::dmat3 eulerRotation(double a, double b, double c) {
  const double sa = sinDegrees(a), ca = cosDegrees(a), sb = sinDegrees(b), cb = cosDegrees(b), sc = sinDegrees(c), cc = cosDegrees(c);
  return {{cb * cc, cb * sc, -sb},
          {cc * sa * sb - ca * sc, ca * cc + sa * sb * sc, cb * sa},
          {ca * cc * sb + sa * sc, ca * sb * sc - cc * sa, ca * cb}};
}

glm::dmat3 axisRotation(double degrees, const glm::dvec3& axis) {
  const double s = sinDegrees(degrees), c = cosDegrees(degrees), square = glm::dot(axis, axis);
  const glm::dvec3 v = axis * ((1 - c) / square), u = axis * (s / std::sqrt(square));
  return {{v.x * axis.x + c, v.x * axis.y + u.z, v.x * axis.z - u.y},
          {v.y * axis.x - u.z, v.y * axis.y + c, v.y * axis.z + u.x},
          {v.z * axis.x + u.y, v.z * axis.y - u.x, v.z * axis.z + c}};
}

std::optional<glm::dmat3> findEuler(const glm::dmat3& m, const glm::dmat3& written, double scale, double least) {
  const double b = std::asin(std::clamp(-m[0].z, -1.0, 1.0)) * kDegreesPerRadian;
  // Where x and z axes fall together, only the sum of their angles is seen: all of it goes to z.
  const bool locked = std::abs(m[0].z) > 1 - 1e-6;
  const double a = locked ? 0 : std::atan2(m[1].z, m[2].z) * kDegreesPerRadian;
  const double c = (locked ? std::atan2(-m[1].x, m[1].y) : std::atan2(m[0].y, m[0].x)) * kDegreesPerRadian;
  // Near ±90° the sine hardly moves, the rows that lie across tell the angle better; and the other two angles are told apart badly.
  const double across = std::hypot(m[0].x, m[0].y);
  const double steep = std::copysign(std::acos(std::clamp(across, 0.0, 1.0)) * kDegreesPerRadian, b);
  const double tolerance = locked ? least : std::max(std::min(least / across, kMostAngleTolerance), least);
  const std::vector<double> bs = locked ? std::vector<double>{std::copysign(90.0, b)} : roundAngles(std::abs(b) > 45 ? steep : b, least);
  const std::vector<double> as = roundAngles(a, tolerance), cs = roundAngles(c, tolerance);
  for (const double roundB : bs) {
    for (const double roundA : as) {
      for (const double roundC : cs) {
        const glm::dmat3 candidate = eulerRotation(roundA, roundB, roundC) * scale;
        if (printsAs(candidate, written)) return candidate;
      }
    }
  }
  return std::nullopt;
}

// The axis of a rotation, from its symmetric part where the turn is near a half one.
glm::dvec3 axisOf(const glm::dmat3& m) {
  const glm::dvec3 skew(m[1].z - m[2].y, m[2].x - m[0].z, m[0].y - m[1].x);
  const double trace = m[0].x + m[1].y + m[2].z;
  if (trace > -0.5) return skew;
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (m[i][i] > m[largest][largest]) largest = i;
  }
  glm::dvec3 axis = m[largest] + glm::dvec3(m[0][largest], m[1][largest], m[2][largest]);
  axis[largest] = 2 * m[largest][largest] + 1 - trace;
  return glm::dot(axis, skew) < 0 ? -axis : axis;
}

std::optional<glm::dmat3> findAxis(const glm::dmat3& m, const glm::dmat3& written, double scale, double least) {
  const glm::dvec3 axis = axisOf(m);
  const double largest = std::max({std::abs(axis.x), std::abs(axis.y), std::abs(axis.z)});
  if (!(largest > 1e-3)) return std::nullopt;
  const double cosine = std::clamp((m[0].x + m[1].y + m[2].z - 1) / 2, -1.0, 1.0);
  const glm::dvec3 skew(m[1].z - m[2].y, m[2].x - m[0].z, m[0].y - m[1].x);
  const double degrees = std::atan2(glm::length(skew) / 2, cosine) * kDegreesPerRadian;
  const std::vector<double> angles = roundAngles(degrees, least);
  for (int k = 1; k <= kMaxAxisEntry; ++k) {
    const glm::dvec3 scaled = axis * (k / largest);
    const glm::dvec3 whole = glm::round(scaled);
    if (glm::length(whole - scaled) > 1e-4) continue;
    for (const double angle : angles) {
      const glm::dmat3 candidate = axisRotation(angle, whole) * scale;
      if (printsAs(candidate, written)) return candidate;
    }
  }
  return std::nullopt;
}

// The nearest rotation: Newton's iteration for the polar decomposition.
std::optional<glm::dmat3> nearestRotation(glm::dmat3 m, const glm::dmat3& written, double scale) {
  for (int i = 0; i < 4; ++i) m = (m + glm::transpose(glm::inverse(m))) * 0.5;
  const glm::dmat3 candidate = m * scale;
  if (!printsAs(candidate, written)) return std::nullopt;
  return candidate;
}

// The largest error that printing with six digits can have left in an entry, relative to the scale.
double entryError(const glm::dmat3& written, double scale) {
  double largest = 0;
  for (int i = 0; i < 9; ++i) {
    if (written[i / 3][i % 3] != 0) largest = std::max(largest, 0.5 * sixthPlace(written[i / 3][i % 3]) / scale);
  }
  return largest;
}

bool isNearlyRotation(const glm::dmat3& m, double error) {
  const glm::dmat3 product = glm::transpose(m) * m;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (!(std::abs(product[c][r] - (c == r ? 1 : 0)) < kNearlyRotation * error)) return false;
    }
  }
  return true;
}

// A scale is a short number, or was none.
double roundScale(double scale, double error) {
  for (double digits = 1; digits <= kDigits; ++digits) {
    const double unit = std::pow(10.0, std::floor(std::log10(scale)) + 1 - digits);
    const double rounded = std::round(scale / unit) * unit;
    if (std::abs(rounded - scale) <= 2 * error * scale) return rounded;
  }
  return scale;
}

// Entries 0 and ±1 only, or no entry off the diagonal: nothing was rounded that could be restored.
bool isPlain(const glm::dmat3& m) {
  bool diagonal = true, units = true;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      if (c != r && m[c][r] != 0) diagonal = false;
      if (m[c][r] != 0 && std::abs(m[c][r]) != 1) units = false;
    }
  }
  return diagonal || units;
}

}  // namespace

int significantDigits(std::string_view text) {
  int digits = 0, trailingZeros = 0;
  bool leading = true, fraction = false;
  for (const char c : text) {
    if (c == 'e' || c == 'E') break;
    if (c == '.') fraction = true;
    if (c < '0' || c > '9') continue;
    if (leading && c == '0') continue;
    leading = false;
    ++digits;
    trailingZeros = c == '0' ? trailingZeros + 1 : 0;
  }
  // The zeros of 1200000 need not be digits; those of 1.000000 were written on purpose.
  return fraction ? digits : digits - trailingZeros;
}

bool restoreRotation(glm::dmat3& matrix) {
  if (isPlain(matrix)) return false;
  const double determinant = glm::determinant(matrix);
  if (!std::isfinite(determinant) || determinant == 0) return false;
  // A mirror is a rotation with all signs turned.
  const double sign = determinant < 0 ? -1 : 1;
  const glm::dmat3 written = matrix * sign;
  const double meanScale = std::cbrt(std::abs(determinant));
  const double error = entryError(written, meanScale);
  const double scale = roundScale(meanScale, error);
  const glm::dmat3 rotation = written / scale;
  if (!isNearlyRotation(rotation, error)) return false;
  const double leastAngle = kAngleTolerance * error * kDegreesPerRadian;
  std::optional<glm::dmat3> found = findEuler(rotation, written, scale, leastAngle);
  if (!found) found = findAxis(rotation, written, scale, leastAngle);
  if (!found) found = nearestRotation(rotation, written, scale);
  if (!found) return false;
  matrix = withZeros(*found, written) * sign;
  return true;
}

glm::dmat4 restoreMatrix(const glm::dmat4& matrix, const MatrixTexts& texts) {
  glm::dmat3 rotation(matrix);
  if (isPlain(rotation)) return matrix;
  for (std::size_t r = 0; r < 3; ++r) {
    for (std::size_t c = 0; c < 3; ++c) {
      if (texts[4 * r + c].empty() || significantDigits(texts[4 * r + c]) > kDigits) return matrix;
    }
  }
  if (!restoreRotation(rotation)) return matrix;
  glm::dmat4 restored(rotation);
  restored[3] = matrix[3];
  return restored;
}

}  // namespace copeel::csg
