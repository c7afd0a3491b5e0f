// Meshes by formula: no files needed, the same on every machine.
#pragma once

#include "core/scene/mesh.h"

namespace copeel::bench {

Mesh bumpySphere(unsigned columns, unsigned rows);                // closed, radius about 1; 2 · columns · rows triangles, less a few at the poles
Mesh shells(unsigned count, unsigned columns, unsigned rows);     // closed convex shells in one another: exactly 2 · count layers in the middle
Mesh cube();                                                      // the unit one, 12 triangles
Mesh cutSquare(unsigned cells, bool otherDiagonal);               // [-1, 1]², each cell cut along one diagonal or the other
Mesh hairs(int count, int joints);                                // three-sided tubes that wander from a ball: 6 · count · joints triangles
Mesh hairball(int count, int joints);                             // six-sided tubes that wander within a ball of radius 1: 12 · count · joints triangles

}  // namespace copeel::bench
