// The way of a .csg: text, syntax, what openscad must evaluate, model.
#include <fstream>
#include <filesystem>
#include <sstream>

#include "apps/csg/csg_syntax.h"
#include "apps/csg/evaluate.h"
#include "apps/csg/external.h"
#include "apps/csg/read_model.h"
#include "apps/csg/shapes.h"
#include "core/error.h"

namespace copeel::csg {
namespace {

std::string readText(const std::string& path) {
  if (std::filesystem::is_directory(path)) failInput("{}: is a directory", path);
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  if (!file) failInput("{}: cannot be opened: {}", path, std::generic_category().message(errno));
  std::string text(static_cast<std::size_t>(std::max<std::streamoff>(file.tellg(), 0)), '\0');
  file.seekg(0);
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (!file) failInput("{}: cannot be read", path);
  return text;
}

}  // namespace

Model readCsg(const std::string& path, const ReadOptions& options) {
  return parseCsg(readText(path), path, std::filesystem::path(path).parent_path().string(), options);
}

Model parseCsg(const std::string& text, const std::string& name, const std::string& folder, const ReadOptions&) {
  const SyntaxTree tree = parseSyntax(text, name);
  const ExternalShapes external;
  Shapes shapes(tree, folder, external);
  Model model = evaluate(tree, shapes);
  model.warnings.insert(model.warnings.end(), shapes.warnings().begin(), shapes.warnings().end());
  return model;
}

}  // namespace copeel::csg
