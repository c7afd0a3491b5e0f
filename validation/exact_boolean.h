// Exact Booleans by CGAL: a CSG model to the mesh of its result, with rational coordinates.
// The implementation links parts of CGAL under GPL-3.0-or-later (corefinement, Nef polyhedra); this folder is built only with COPEEL_VALIDATION and is
// never part of the program or of copeel::core.
//
// Corefinement is tried first (milliseconds); where its result would not be manifold (solids that touch in an edge or a vertex) Nef
// polyhedra answer (tens of milliseconds per small leaf). Leaves must be closed and free of self-intersections: no answer otherwise.
// The leaves' doubles are taken as exact, so leaves turned one by one keep their films of 1e-15: build the truth from leaves on
// the grid and turn the result with transformedExactly.
#pragma once

#include <optional>
#include <string>

#include "apps/csg/csg_model.h"
#include "validation/oracle_mesh.h"

namespace copeel::validation {

enum class ExactKernel { CorefinementThenNef, Corefinement, Nef };

struct ExactResult {
  OracleMesh mesh;           // closed, counter-clockwise seen from outside; no triangles: the empty solid
  std::string kernel;        // "corefinement" or "nef"
};

// Nothing when no kernel can answer for this model.
std::optional<ExactResult> exactBoolean(const csg::Model& model, ExactKernel kernel = ExactKernel::CorefinementThenNef);

}  // namespace copeel::validation
