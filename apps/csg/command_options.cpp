#include "apps/csg/command_options.h"

#include <filesystem>

#include <CLI/CLI.hpp>

#include "apps/command/parse_values.h"
#include "apps/csg/color_schemes.h"
#include "core/error.h"
#include "core/methods/method.h"

namespace copeel::csg {
namespace {

// "x=10" cuts away what lies beyond, "-x=10" what lies before.
Section parseSection(const std::string& text) {
  std::string_view rest = text;
  const bool below = rest.starts_with('-');
  if (below) rest.remove_prefix(1);
  const auto axis = rest.size() >= 3 && rest[1] == '=' ? std::string_view("xyz").find(rest[0]) : std::string_view::npos;
  if (axis == std::string_view::npos) failUsage("--section takes x=NUMBER, y=NUMBER or z=NUMBER, or -x=NUMBER and so on, not '{}'", text);
  return {static_cast<int>(axis), parseNumber(rest.substr(2), "--section"), below};
}

InsideRule parseInside(const std::string& text) {
  if (text == "nonzero") return InsideRule::NonZero;
  if (text == "positive") return InsideRule::Positive;
  if (text == "odd") return InsideRule::Odd;
  failUsage("--inside takes one of nonzero|positive|odd, not '{}'", text);
}

// A repeatable option that takes one value each time and leaves the file after it alone.
template <class Take>
void addRepeatable(CLI::App& command, const std::string& name, const std::string& valueName, const std::string& help, Take take) {
  command
      .add_option_function<std::vector<std::string>>(
          name, [take](const std::vector<std::string>& values) { for (const std::string& value : values) take(value); }, help)
      ->type_name(valueName)
      ->allow_extra_args(false);
}

}  // namespace

void addOptions(CLI::App& command, CommandOptions& options) {
  command.add_option("files", options.inputs, "a .scad, a .csg, or meshes (STL, OBJ, OFF, PLY), each with a look if wanted: MESH:color=#rrggbb,alpha=0.3")
      ->required()
      ->type_name("FILE");
  command.add_option("--expr", options.expression, "combines the meshes, A for the first and so on: '(A - B) & C'; without it they are united")
      ->type_name("EXPRESSION");
  addRepeatable(command, "-D", "NAME=VALUE", "defines a variable of the .scad", [&options](const std::string& text) {
    // openscad would put what is no definition down to the file.
    const std::size_t equals = text.find('=');
    const bool hasValue = equals != std::string::npos && text.find_first_not_of(" \t;", equals + 1) != std::string::npos;
    if (!hasValue || equals == 0) failUsage("-D takes NAME=VALUE, not '{}'", text);
    options.definitions.push_back(text);
  });
  addRepeatable(command, "--section", "AXIS=NUMBER", "cuts away what lies beyond x=10, or before it: -x=10, and shows the cut",
                [&options](const std::string& text) { options.sections.push_back(parseSection(text)); });
  command.add_option_function<std::string>("--inside", [&options](const std::string& text) { options.inside = parseInside(text); },
                                           "which winding numbers of a leaf are inside it (nonzero)")
      ->type_name("nonzero|positive|odd");
  command.add_option_function<std::string>("--colorscheme", [&options](const std::string& name) { options.scheme = colorScheme(name); },
                                           "openscad's colours: " + colorSchemeNames())
      ->type_name("NAME");
  command.add_flag("--edges", options.edges, "draws the edges of the faces");
  addCommonOptions(command, options.common);
}

InputKind inputKind(const CommandOptions& options) {
  const auto endingOf = [](const std::string& path) { return CLI::detail::to_lower(std::filesystem::path(path).extension().string()); };
  InputKind kind = InputKind::Meshes;
  for (const std::string& input : options.inputs) {
    if (endingOf(input) == ".scad") kind = InputKind::Scad;
    if (endingOf(input) == ".csg") kind = InputKind::Csg;
  }
  if (kind != InputKind::Meshes && options.inputs.size() > 1) failUsage("a .scad or .csg stands alone; several files must all be meshes");
  if (kind != InputKind::Meshes && !options.expression.empty()) failUsage("--expr combines meshes; a .scad or .csg has its own tree");
  if (kind != InputKind::Scad && !options.definitions.empty()) failUsage("-D defines variables of a .scad only");
  if (options.common.method == "zbuffer" && !options.sections.empty()) {
    failUsage("--section cuts a solid; --method zbuffer draws every leaf whole and knows of none");
  }
  return kind;
}

RenderOptions renderOptions(const CommandOptions& options) {
  const CommonOptions& common = options.common;
  RenderOptions render;
  render.inside = options.inside;
  render.scheme = options.scheme;
  if (common.background) render.scheme.background = *common.background;
  render.lit = common.lit;
  render.edges = options.edges;
  render.sections = options.sections;
  render.coplanarTolerance = common.coplanarTolerance;
  render.threads = common.threads;
  render.samples = common.samples;
  render.methodOptions = common.methodOptions;
  render.method = &chooseMethod(common.backend, common.method, render.methodOptions);
  render.wantDepth = !common.depthFile.empty();
  render.wantIds = !common.idsFile.empty();
  return render;
}

}  // namespace copeel::csg
