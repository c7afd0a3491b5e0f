// The box that openscad's --viewall and --autocenter take: boxes of leaves (a placed box, not a box of placed vertices) combined by the tree:
// a union has all, an intersection the common part, a difference its first operand's.
#pragma once

#include "apps/csg/csg_model.h"
#include "core/scene/box.h"

namespace copeel::csg {

Box viewBounds(const Model& model);

}  // namespace copeel::csg
