// The way of a .csg: text, syntax, what openscad must evaluate, model. And of a .scad: openscad, then the same.
#include <filesystem>
#include <string_view>

#include "apps/csg/csg_syntax.h"
#include "apps/csg/evaluate.h"
#include "apps/csg/external.h"
#include "apps/csg/openscad_log.h"
#include "apps/csg/process.h"
#include "apps/csg/read_model.h"
#include "apps/csg/shapes.h"
#include "core/error.h"
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

Model modelOfFile(const std::string& path, const std::string& name, const std::string& folder, const ReadOptions& options) {
  const InputFile file(path);
  const Source source = file.source();
  return modelOf({source.data(), source.size()}, name, folder, options);
}

std::string folderOf(const std::string& path) { return std::filesystem::path(path).parent_path().string(); }

}  // namespace

Model parseCsg(const std::string& text, const std::string& name, const std::string& folder, const ReadOptions& options) {
  return modelOf(text, name, folder, options);
}

Model readCsg(const std::string& path, const ReadOptions& options) { return modelOfFile(path, path, folderOf(path), options); }

Model readScad(const std::string& path, const ReadOptions& options) {
  { const InputFile readable(path); }   // says what is wrong with it better than openscad does
  const TemporaryFolder temporary(std::filesystem::temp_directory_path().string());
  const std::string csg = (std::filesystem::path(temporary.path()) / "model.csg").string();
  // Absolute paths: openscad takes a relative output for one beside the source, and a name with a leading dash for an option.
  const std::string source = std::filesystem::absolute(path).string();
  std::vector<Command> commands(1);
  commands[0].arguments = {options.openscad, "-o", csg};
  for (const std::string& definition : options.definitions) commands[0].arguments.insert(commands[0].arguments.end(), {"-D", definition});
  commands[0].arguments.push_back(source);
  commands[0].logPath = (std::filesystem::path(temporary.path()) / "log").string();
  runAll(commands, 1);
  const OpenscadLog log = readOpenscadLog(commands[0].logPath, source, path);
  if (!log.errors.empty()) throw Error(ExitCode::Input, log.errors.front());
  if (commands[0].exitCode == 127) failMachine("{}: cannot be run", options.openscad);
  std::error_code error;
  if (commands[0].exitCode != 0 || !std::filesystem::exists(csg, error)) {
    failMachine("{}: openscad failed with code {}", path, commands[0].exitCode);
  }
  // Paths within the .csg start where the source lies, wherever the .csg is written.
  Model model = modelOfFile(csg, path + " (as .csg)", folderOf(source), options);
  model.warnings.insert(model.warnings.begin(), log.warnings.begin(), log.warnings.end());
  return model;
}

}  // namespace copeel::csg
