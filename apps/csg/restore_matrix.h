// Rotations that openscad wrote with six digits, made exact again.
#pragma once

#include <array>
#include <string_view>

#include <glm/mat4x4.hpp>

namespace copeel::csg {

using MatrixTexts = std::array<std::string_view, 16>;   // row by row, as written; empty where nothing was written

// The matrix whose rotation, printed with six digits, gives the same texts, or the matrix itself.
glm::dmat4 restoreMatrix(const glm::dmat4& matrix, const MatrixTexts& texts);

}  // namespace copeel::csg
