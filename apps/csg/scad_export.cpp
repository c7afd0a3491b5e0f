#include "apps/csg/scad_export.h"

#include <cstring>
#include <filesystem>
#include <optional>

#include "apps/csg/openscad_log.h"
#include "core/error.h"
#include "core/formats/input_file.h"

namespace copeel::csg {
namespace {

namespace fs = std::filesystem;

// Says what is wrong with a file better than openscad does. Absolute paths: openscad takes a relative output for one beside the source, and a
// name with a leading dash for an option.
std::string sourceOf(const std::string& path) {
  const InputFile file(path);
  const Source source = file.source();
  const void* zero = source.size() ? std::memchr(source.data(), 0, source.size()) : nullptr;
  if (zero) source.failAtLine(static_cast<std::size_t>(static_cast<const char*>(zero) - source.data()), "a zero byte: openscad would read no further");
  return fs::absolute(path).string();
}

}  // namespace

ScadExport::ScadExport(const std::string& path, const ReadOptions& options)
    : path_(path), source_(sourceOf(path)), options_(options), temporary_(systemTemporaryFolder()),
      pipe_(temporary_.path() + "/model.csg"), process_(command()) {}

Command ScadExport::command() const {
  Command command;
  command.arguments = {options_.openscad, "-o", temporary_.path() + "/model.csg"};
  for (const std::string& definition : options_.definitions) command.arguments.insert(command.arguments.end(), {"-D", definition});
  command.arguments.push_back(source_);
  command.logPath = temporary_.path() + "/log";
  return command;
}

Model ScadExport::model() {
  const std::optional<std::string> text = pipe_.read(process_);
  const OpenscadLog log = readOpenscadLog(command().logPath, source_, path_);
  warningsSeen_ = log.warnings.size();
  if (!text || !log.errors.empty()) {
    finish();
    failMachine("{}: openscad wrote nothing", path_);
  }
  try {
    // Paths within the .csg start where the source lies, wherever the .csg is written.
    Model model = parseCsg(*text, path_ + " (as .csg)", fs::path(source_).parent_path().string(), options_);
    model.warnings.insert(model.warnings.begin(), log.warnings.begin(), log.warnings.end());
    return model;
  } catch (const Error&) {
    finish();   // a text cut short is the fault of what cut it
    throw;
  }
}

std::vector<std::string> ScadExport::finish() {
  const int exitCode = process_.wait();
  const OpenscadLog log = readOpenscadLog(command().logPath, source_, path_);
  if (!log.errors.empty()) throw Error(ExitCode::Input, log.errors.front());
  if (exitCode == 127) failMachine("{}: cannot be run", options_.openscad);
  if (exitCode != 0) failMachine("{}: openscad failed with code {}", path_, exitCode);
  return {log.warnings.begin() + static_cast<std::ptrdiff_t>(warningsSeen_), log.warnings.end()};
}

}  // namespace copeel::csg
