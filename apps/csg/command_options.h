// What the command line of `copeel csg` says, and its translation for the reader and the renderer.
#pragma once

#include <string>
#include <vector>

#include "apps/command/common_options.h"
#include "apps/csg/read_model.h"
#include "apps/csg/render_csg.h"

namespace CLI {
class App;
}

namespace copeel::csg {

enum class InputKind { Scad, Csg, Meshes };

struct CommandOptions {
  CommonOptions common;
  std::vector<std::string> inputs;          // as given; meshes may carry a look
  std::string expression;                   // --expr, meshes only
  std::vector<std::string> definitions;     // -D, .scad only
  std::vector<Section> sections;
  InsideRule inside = InsideRule::NonZero;
  ColorScheme scheme;
  bool edges = false;
};

// `options` must live as long as `command`.
void addOptions(CLI::App& command, CommandOptions& options);

// By the endings of the inputs; throws Error{Usage} for combinations that make no sense.
InputKind inputKind(const CommandOptions& options);

RenderOptions renderOptions(const CommandOptions& options);

}  // namespace copeel::csg
