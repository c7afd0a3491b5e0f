#include "apps/csg/restore_matrix.h"

namespace copeel::csg {

glm::dmat4 restoreMatrix(const glm::dmat4& matrix, const MatrixTexts&) { return matrix; }

}  // namespace copeel::csg
