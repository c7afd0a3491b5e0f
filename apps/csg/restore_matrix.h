// Rotations that openscad wrote with six digits, made exact again.
//
// The rotation part of a matrix (perhaps mirrored, perhaps scaled alike in all directions) is compared with what people write: turns about
// the axes by round degrees or by fractions of a turn, rotate([a, b, c]) of them, turns about simple axes, mirrors. Only a matrix that gives
// the very numbers of the text when it is printed with six digits is taken for it; failing that the nearest true rotation, under the same
// test; failing that nothing is changed. A matrix with more than six digits anywhere is left alone, and so are translations.
#pragma once

#include <array>
#include <string_view>

#include <glm/mat3x3.hpp>
#include <glm/mat4x4.hpp>

namespace copeel::csg {

using MatrixTexts = std::array<std::string_view, 16>;   // row by row, as written; empty where nothing was written

// The nine numbers of a rotation decide: true where one was restored.
bool restoreRotation(glm::dmat3& matrix);

// Significant digits of a decimal number as written: "0.0180283" has 6, "-1e+10" has 1.
int significantDigits(std::string_view text);

glm::dmat4 restoreMatrix(const glm::dmat4& matrix, const MatrixTexts& texts);

}  // namespace copeel::csg
