// The options of `copeel oit`, and how its meshes are read and drawn; the steps around that are those of every picture (make_picture.h).
#include "apps/oit/command.h"

#include <memory>
#include <utility>

#include <CLI/CLI.hpp>

#include "apps/command/make_picture.h"
#include "apps/oit/read_parts.h"
#include "core/image/write_image.h"

namespace copeel::oit {
namespace {

struct CommandOptions {
  CommonOptions common;
  std::vector<std::string> inputs;   // as given, each with a look or without
  CommonLook look;
  std::string layersFile, coplanarFile;
};

void addOptions(CLI::App& command, CommandOptions& options) {
  command.add_option("meshes", options.inputs, "meshes (STL, OBJ, OFF, PLY), each with a look if wanted: MESH:color=#rrggbb,alpha=0.3")
      ->required()
      ->type_name("MESH");
  command
      .add_option_function<std::string>(
          "--color", [&options](const std::string& text) { options.look.color = parseColor(text, "--color"); },
          "of all meshes without a look of their own (the file's, or one of a palette)")
      ->type_name("#rrggbb");
  command
      .add_option_function<std::string>(
          "--alpha", [&options](const std::string& text) { options.look.alpha = parseAlpha(text, "--alpha"); },
          "opacity of the same, 0 to 1 (the file's, or 0.5)")
      ->type_name("NUMBER");
  command.add_option("--layers", options.layersFile, "fragments of each pixel, 16 bit")->type_name("FILE.pgm");
  command.add_option("--coplanar", options.coplanarFile, "fragments at one depth, the most of each pixel, 16 bit")->type_name("FILE.pgm");
  addCommonOptions(command, options.common);
}

RenderOptions renderOptions(const CommandOptions& options) {
  const CommonOptions& common = options.common;
  RenderOptions render;
  if (common.background) render.background = *common.background;
  render.lit = common.lit;
  render.coplanarTolerance = common.coplanarTolerance;
  render.threads = common.threads;
  render.samples = common.samples;
  render.methodOptions = common.methodOptions;
  render.method = &chooseMethod(common.backend, common.method, render.methodOptions);
  render.wantDepth = !common.depthFile.empty();
  render.wantIds = !common.idsFile.empty();
  render.wantLayers = !options.layersFile.empty();
  render.wantCoplanar = !options.coplanarFile.empty();
  return render;
}

void run(const CommandOptions& options) {
  const CommonOptions& common = options.common;
  const RenderOptions render = renderOptions(options);   // what cannot be is refused before anything is read
  std::vector<MeshArgument> files;
  PictureSteps steps;
  for (const std::string& input : options.inputs) {
    files.push_back(parseMeshArgument(asPath(input)));
    steps.inputs.push_back(files.back().path);
  }

  Frame frame;
  Outputs outputs;
  outputs.add("--depth", common.depthFile, [&](const std::string& path) { writePfm(path, frame.depth); });
  outputs.add("--ids", common.idsFile, [&](const std::string& path) { writePgm(path, frame.ids); });
  outputs.add("--layers", options.layersFile, [&](const std::string& path) { writePgm(path, frame.layers); });
  outputs.add("--coplanar", options.coplanarFile, [&](const std::string& path) { writePgm(path, frame.coplanar); });
  std::vector<Part> parts;
  steps.read = [&] {
    std::vector<std::string> warnings;
    parts = readParts(files, options.look, warnings);
    return warnings;
  };
  steps.draw = [&](Stats& stats) {
    Renderer renderer(std::move(parts), render);
    frame = drawFrames(renderer, common, stats);
  };
  makePicture(common, steps, std::move(outputs), frame.color);
}

}  // namespace

void addCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("oit", "meshes of any opacity to a picture");
  const auto options = std::make_shared<CommandOptions>();
  addOptions(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace copeel::oit
