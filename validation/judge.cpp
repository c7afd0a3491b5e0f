#include "validation/judge.h"

#include "apps/csg/read_model.h"

namespace copeel::validation {
namespace {

csg::Frame drawFrame(const csg::Model& model, const View& view, csg::RenderOptions options) {
  options.wantDepth = true;
  options.wantIds = true;
  options.threads = 1;
  return csg::Renderer(model, options).draw(view);
}

}  // namespace

csg::Model modelOf(const std::string& text) { return csg::parseCsg(text, "scene", ".", {}); }

Comparison judgeByRays(const csg::Model& model, const View& view, csg::RenderOptions options) {
  CsgOracleOptions oracleOptions;
  oracleOptions.inside = options.inside;
  oracleOptions.sections = options.sections;
  if (options.coplanarTolerance > 0) oracleOptions.tolerance = options.coplanarTolerance;
  const CsgOracle oracle(model, view, oracleOptions);
  const csg::Frame frame = drawFrame(model, view, options);
  // A cap belongs to no leaf: leaves are compared where no section cuts.
  return compareDepth(frame.depth, oracle, oracle.caster(), options.sections.empty() ? &frame.ids : nullptr);
}

Comparison judgeByMesh(const csg::Model& model, const OracleMesh& truth, const View& view, csg::RenderOptions options) {
  const CsgOracle leaves(model, view);
  const MeshOracle oracle(truth, view, leaves.diagonal());
  return compareDepth(drawFrame(model, view, options).depth, oracle, leaves.caster());
}

}  // namespace copeel::validation
