// The box that openscad 2021.01's --viewall and --autocenter take. It turns the tree into a sum of products and takes the boxes of all leaves
// that a product intersects (a placed box, not a box of placed vertices), not of their common part; what a product subtracts does
// not count, and products whose boxes have nothing in common are dropped.
#pragma once

#include "apps/csg/csg_model.h"
#include "core/scene/box.h"

namespace copeel::csg {

// Without forming products: O(nodes). Where unions are intersected with unions, a leaf counts when its box meets the box of each of the others
// as a whole; openscad asks their leaves one by one, and may leave out a leaf that counts here.
Box viewBounds(const Model& model);

}  // namespace copeel::csg
