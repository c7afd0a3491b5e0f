// Exact Booleans by CGAL: a CSG model to the mesh of its result, with rational coordinates.
// The implementation links parts of CGAL under GPL-3.0-or-later (corefinement, Nef polyhedra); this folder is built only with COPEEL_VALIDATION and is
// never part of the program or of copeel::core.
//
// Nef polyhedra answer every closed leaf free of self-intersections, in tens of milliseconds per small leaf. Corefinement is a hundred times faster
// and meant for large parts in general position: on coincident faces CGAL 5.5's was seen to crash and to run for ever (random scenes from seed
// 2001), and a result that is not manifold it refuses. No answer for other leaves.
// The leaves' doubles are taken as exact, so leaves turned one by one keep their films of 1e-15: build the truth from leaves on
// the grid and turn the result with transformedExactly.
#pragma once

#include <optional>

#include "apps/csg/csg_model.h"
#include "validation/oracle_mesh.h"

namespace copeel::validation {

enum class ExactKernel { Nef, Corefinement };

// The result is closed and counter-clockwise seen from outside; no triangles: the empty solid. Nothing when the kernel cannot answer.
std::optional<OracleMesh> exactBoolean(const csg::Model& model, ExactKernel kernel = ExactKernel::Nef);

}  // namespace copeel::validation
