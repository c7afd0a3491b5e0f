// Which files make the model, and how it is read and drawn; the steps around that are those of every picture (make_picture.h).
#include "apps/csg/command.h"

#include <functional>
#include <future>
#include <memory>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>

#include "apps/command/make_picture.h"
#include "apps/command/parse_values.h"
#include "apps/csg/command_options.h"
#include "apps/csg/scad_camera.h"
#include "apps/csg/scad_export.h"
#include "core/error.h"
#include "core/image/write_image.h"
#include "core/parallel.h"

namespace copeel::csg {
namespace {

std::vector<MeshArgument> filesOf(const CommandOptions& options, InputKind kind) {
  std::vector<MeshArgument> files;
  for (const std::string& input : options.inputs) {
    files.push_back(kind == InputKind::Meshes ? parseMeshArgument(asPath(input)) : MeshArgument{asPath(input), {}, {}});
  }
  return files;
}

// An alpha without a colour leaves red, green and blue to the scheme, which knows what is subtracted.
glm::dvec4 lookOf(const MeshArgument& file) {
  const double alpha = file.alpha.value_or(1.0);
  if (!file.color) return {-1, -1, -1, alpha};
  return {(*file.color)[0] / 255, (*file.color)[1] / 255, (*file.color)[2] / 255, alpha};
}

Model readMeshFiles(const CommandOptions& options, const std::vector<MeshArgument>& files) {
  std::vector<std::string> paths;
  for (const MeshArgument& file : files) paths.push_back(file.path);
  std::vector<std::size_t> fileOfLeaf;
  Model model = readMeshes(paths, options.expression, &fileOfLeaf);
  for (std::size_t i = 0; i < model.leaves.size(); ++i) {
    const MeshArgument& file = files[fileOfLeaf[i]];
    if (file.color || file.alpha) model.leaves[i].color = lookOf(file);
  }
  return model;
}

void drawAndEncodeCube(const CommonOptions& common) {
  constexpr int kMostSidePx = 1024;
  const Model cube = parseCsg("cube(1);", "", "", {});
  RenderOptions options;
  options.threads = 1;
  Renderer renderer(cube, options);
  View view = viewOf(common.camera, renderer.bounds());
  view.width = std::min(view.width, kMostSidePx);
  view.height = std::min(view.height, kMostSidePx);
  const Frame frame = renderer.draw(view);
  Threads(1).execute([&] { encodePng(frame.color); });
}

// A first picture costs 3 ms more than the next: memory and code are touched for the first time. That is paid with one of nothing much while
// openscad starts, on one thread, as openscad needs another. A new one: the system gives it a processor of its own, where this one and openscad
// would share theirs for 20 ms.
void warmUp(const CommonOptions& common) {
  if (std::thread::hardware_concurrency() < 2) return;
  try {
    std::async(std::launch::async, drawAndEncodeCube, std::cref(common)).get();
  } catch (const std::system_error&) {   // no thread is to be had
  }
}

// openscad is left at its way out: `scad` is to be finished before the model is believed.
Model readModel(CommandOptions& options, InputKind kind, const std::vector<MeshArgument>& files, std::optional<ScadExport>& scad) {
  ReadOptions read;
  read.definitions = options.definitions;
  if (kind == InputKind::Meshes) return readMeshFiles(options, files);
  if (kind == InputKind::Csg) return readCsg(files[0].path, read);
  scad.emplace(files[0].path, read);
  warmUp(options.common);
  Model model = scad->model();
  applyViewVariables(files[0].path, read, model, options.common.camera);
  return model;
}

// An id is a leaf's number from 1 in 16 bits.
void warnOfSharedIds(Model& model) {
  constexpr std::size_t kMostIds = 65534;
  if (model.leaves.size() <= kMostIds) return;
  model.warnings.push_back(fmt::format("--ids: there are {} leaves; those after the first {} share the id {}", model.leaves.size(), kMostIds, kMostIds + 1));
}

void run(CommandOptions options) {
  const InputKind kind = inputKind(options);
  const CommonOptions& common = options.common;
  const RenderOptions render = renderOptions(options);   // what cannot be is refused before anything is read
  const std::vector<MeshArgument> files = filesOf(options, kind);

  Frame frame;
  Outputs outputs;
  outputs.add("--depth", common.depthFile, [&](const std::string& path) { writePfm(path, frame.depth); });
  outputs.add("--ids", common.idsFile, [&](const std::string& path) { writePgm(path, frame.ids); });
  PictureSteps steps;
  for (const MeshArgument& file : files) steps.inputs.push_back(file.path);
  std::optional<ScadExport> scad;
  std::optional<Model> model;
  steps.read = [&] {
    model = readModel(options, kind, files, scad);
    if (!common.idsFile.empty()) warnOfSharedIds(*model);
    return model->warnings;
  };
  steps.draw = [&](Stats& stats) {
    Renderer renderer(*model, render);
    frame = drawFrames(renderer, common, stats);
  };
  steps.finish = [&] { return scad ? scad->finish() : std::vector<std::string>(); };
  makePicture(common, steps, std::move(outputs), frame.color);
}

}  // namespace

void addCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("csg", "a CSG model (.scad, .csg or meshes) to a picture");
  const auto options = std::make_shared<CommandOptions>();
  addOptions(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace copeel::csg
