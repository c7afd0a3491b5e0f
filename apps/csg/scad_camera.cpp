#include "apps/csg/scad_camera.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>

#include "apps/csg/process.h"

namespace copeel::csg {
namespace {

// openscad says so whenever one of the three is set at the top of the source.
constexpr const char* kSign = "Viewall and autocenter disabled in favor of $vp*";

// What openscad has in them where the source sets nothing.
constexpr std::array<double, 7> kUnset = {0, 0, 0, 0, 0, 0, 500};

std::string textOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

// The three as openscad sees them at the end of the source: translation, turn, distance.
std::optional<std::array<double, 7>> askOpenscad(const std::string& path, const ReadOptions& options) {
  const TemporaryFolder temporary(systemTemporaryFolder());
  const std::string echo = temporary.path() + "/view.echo";
  std::vector<Command> commands(1);
  commands[0].arguments = {options.openscad, "-o", echo};
  for (const std::string& definition : options.definitions) commands[0].arguments.insert(commands[0].arguments.end(), {"-D", definition});
  commands[0].arguments.insert(commands[0].arguments.end(),
                               {"-D", "copeel_view=echo(COPEEL_VIEW=[each $vpt,each $vpr,$vpd]) 0", std::filesystem::absolute(path).string()});
  commands[0].logPath = temporary.path() + "/log";
  runAll(commands, 1);
  const std::string text = textOf(echo);
  const auto at = text.rfind("COPEEL_VIEW = [");
  std::array<double, 7> v{};
  if (at == std::string::npos || std::sscanf(text.c_str() + at, "COPEEL_VIEW = [%lf, %lf, %lf, %lf, %lf, %lf, %lf]", &v[0], &v[1], &v[2], &v[3],
                                             &v[4], &v[5], &v[6]) != 7) {
    return std::nullopt;
  }
  return v;
}

// A value that differs from openscad's own was set; one that does not, was when the source writes it (it may also be an included file).
bool isSet(const std::string& source, const std::string& name, const double* value, const double* unset, int count) {
  if (!std::equal(value, value + count, unset)) return true;
  for (std::size_t at = source.find(name); at != std::string::npos; at = source.find(name, at + 1)) {
    const std::size_t next = source.find_first_not_of(" \t\r\n", at + name.size());
    if (next != std::string::npos && source[next] == '=' && source.compare(next, 2, "==") != 0) return true;
  }
  return false;
}

}  // namespace

void applyViewVariables(const std::string& path, const ReadOptions& options, Model& model, CameraOptions& camera) {
  const auto isSign = [](const std::string& warning) { return warning.find(kSign) != std::string::npos; };
  if (std::erase_if(model.warnings, isSign) == 0) return;
  const std::optional<std::array<double, 7>> view = askOpenscad(path, options);
  if (!view) {
    model.warnings.push_back(path + ": $vpt, $vpr or $vpd is not a vector of three numbers or a number; ignored");
    return;
  }
  std::vector<double> numbers = gimbalNumbers(camera.camera);
  const std::string source = textOf(path);
  const struct { const char* name; int first, count; } variables[] = {{"$vpt", 0, 3}, {"$vpr", 3, 3}, {"$vpd", 6, 1}};
  for (const auto& [name, first, count] : variables) {
    if (isSet(source, name, view->data() + first, kUnset.data() + first, count)) std::copy_n(view->data() + first, count, numbers.begin() + first);
  }
  camera.camera = numbers;
  camera.viewAll = camera.autoCenter = false;
}

}  // namespace copeel::csg
