// A syntax tree to a model: matrices multiplied down, colours and modifiers resolved, leaves made, trees in post-order.
#pragma once

#include "apps/csg/csg_model.h"
#include "apps/csg/csg_syntax.h"
#include "apps/csg/shapes.h"

namespace copeel::csg {

Model evaluate(const SyntaxTree& tree, Shapes& shapes);

}  // namespace copeel::csg
