// The way of a .csg: text, syntax, what openscad must evaluate, model. And of a .scad: openscad, then the same.
#include <filesystem>
#include <string_view>

#include "apps/csg/csg_syntax.h"
#include "apps/csg/evaluate.h"
#include "apps/csg/external.h"
#include "apps/csg/read_model.h"
#include "apps/csg/scad_export.h"
#include "apps/csg/shapes.h"
#include "core/formats/input_file.h"

namespace copeel::csg {
namespace {

Model modelOf(std::string_view text, const std::string& name, const std::string& folder, const ReadOptions& options) {
  const SyntaxTree tree = parseSyntax(text, name);
  ExternalShapes external = evaluateExternal(tree, folder, options);
  Shapes shapes(tree, folder, external);
  Model model = evaluate(tree, shapes);
  for (const std::vector<std::string>* more : {&external.warnings, &shapes.warnings()}) {
    model.warnings.insert(model.warnings.end(), more->begin(), more->end());
  }
  return model;
}

std::string folderOf(const std::string& path) { return std::filesystem::path(path).parent_path().string(); }

}  // namespace

Model parseCsg(const std::string& text, const std::string& name, const std::string& folder, const ReadOptions& options) {
  return modelOf(text, name, folder, options);
}

Model readCsg(const std::string& path, const ReadOptions& options) {
  const InputFile file(path);
  const Source source = file.source();
  return modelOf({source.data(), source.size()}, path, folderOf(path), options);
}

Model readScad(const std::string& path, const ReadOptions& options) {
  ScadExport scad(path, options);
  Model model = scad.model();
  const std::vector<std::string> more = scad.finish();
  model.warnings.insert(model.warnings.end(), more.begin(), more.end());
  return model;
}

}  // namespace copeel::csg
