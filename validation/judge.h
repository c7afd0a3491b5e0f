// A model, its renderer and the exact answer, brought together: what the tests of scenes and hard cases call.
#pragma once

#include <string>

#include "apps/csg/csg_model.h"
#include "apps/csg/render_csg.h"
#include "validation/compare.h"

namespace copeel::validation {

// A .csg text as a model; no files, no openscad.
csg::Model modelOf(const std::string& text);

// The renderer's depth and leaves against the oracle that reads the same model.
Comparison judgeByRays(const csg::Model& model, const View& view, csg::RenderOptions options = {});

// The renderer's depth against the mesh of an exact Boolean, in the scene's place.
Comparison judgeByMesh(const csg::Model& model, const OracleMesh& truth, const View& view, csg::RenderOptions options = {});

}  // namespace copeel::validation
