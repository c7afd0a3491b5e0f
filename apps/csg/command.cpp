// The steps: read the model, prepare, draw as often as asked, write everything at once.
#include "apps/csg/command.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>
#include <utility>

#include <CLI/CLI.hpp>
#include <sys/resource.h>

#include "apps/command/outputs.h"
#include "apps/command/parse_values.h"
#include "apps/command/progress.h"
#include "apps/csg/command_options.h"
#include "apps/csg/scad_camera.h"
#include "apps/csg/scad_export.h"
#include "core/error.h"
#include "core/image/write_image.h"
#include "core/output_file.h"
#include "core/parallel.h"

namespace copeel::csg {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

// A name with a leading dash is a file all the same, to us and to the programs we hand it to.
std::string asPath(const std::string& name) { return name.starts_with('-') ? "./" + name : name; }

std::vector<MeshArgument> filesOf(const CommandOptions& options, InputKind kind) {
  std::vector<MeshArgument> files;
  for (const std::string& input : options.inputs) {
    files.push_back(kind == InputKind::Meshes ? parseMeshArgument(asPath(input)) : MeshArgument{asPath(input), {}, {}});
  }
  return files;
}

// Said here, once for all readers, in the words of the system.
void checkReadable(const std::string& path) {
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) failInput("{}: is a directory", path);
  // A pipe can be opened once only: whoever writes it would see its reader go.
  if (std::filesystem::is_fifo(path, error)) return;
  if (std::FILE* file = std::fopen(path.c_str(), "rbe")) {
    std::fclose(file);
    return;
  }
  failInput("{}: {}", path, std::generic_category().message(errno));
}

// An alpha without a colour keeps the scheme's.
glm::dvec4 lookOf(const MeshArgument& file, const ColorScheme& scheme) {
  const std::array<double, 3> color = file.color.value_or(scheme.front);
  return {color[0] / 255, color[1] / 255, color[2] / 255, file.alpha.value_or(1.0)};
}

Model readMeshFiles(const CommandOptions& options, const std::vector<MeshArgument>& files) {
  std::vector<std::string> paths;
  for (const MeshArgument& file : files) paths.push_back(file.path);
  std::vector<std::size_t> fileOfLeaf;
  Model model = readMeshes(paths, options.expression, &fileOfLeaf);
  for (std::size_t i = 0; i < model.leaves.size(); ++i) {
    const MeshArgument& file = files[fileOfLeaf[i]];
    if (file.color || file.alpha) model.leaves[i].color = lookOf(file, options.scheme);
  }
  return model;
}

// A first frame costs 2 ms more than the next: threads start, memory and code are touched for the first time. That is paid with a picture of
// nothing much while openscad starts.
void warmUp(const CommonOptions& common) {
  if (std::thread::hardware_concurrency() < 2) return;
  constexpr int kMostSidePx = 1024;
  const Model cube = parseCsg("cube(1);", "", "", {});
  RenderOptions options;
  options.threads = common.threads;
  Renderer renderer(cube, options);
  View view = viewOf(common.camera, renderer.bounds());
  view.width = std::min(view.width, kMostSidePx);
  view.height = std::min(view.height, kMostSidePx);
  renderer.draw(view);
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

struct Drawing {
  Frame frame;
  Stats stats;
};

Drawing draw(const Model& model, const CommandOptions& options) {
  Renderer renderer(model, renderOptions(options));
  const View view = viewOf(options.common.camera, renderer.bounds());
  Drawing drawing;
  std::vector<double> times;
  for (int i = 0; i < options.common.frames; ++i) {
    const auto start = Clock::now();
    drawing.frame = renderer.draw(view);
    times.push_back(millisecondsSince(start));
  }
  drawing.stats = renderer.stats();
  std::sort(times.begin(), times.end());
  drawing.stats.frameMinMs = times.front();
  drawing.stats.frameMedianMs = (times[times.size() / 2] + times[(times.size() - 1) / 2]) / 2;
  return drawing;
}

std::uint64_t peakMemoryBytes() {
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;   // Linux counts in KiB
}

void run(CommandOptions options) {
  const auto start = Clock::now();
  const InputKind kind = inputKind(options);
  checkBackend(options.common);
  const std::vector<MeshArgument> files = filesOf(options, kind);
  // A view that cannot be is refused before anything is read.
  viewOf(options.common.camera, Box{{0, 0, 0}, {1, 1, 1}});

  Drawing drawing;
  const CommonOptions& common = options.common;
  Outputs outputs;   // the picture last: once it is there, so is everything else
  outputs.add("--depth", common.depthFile, [&](const std::string& path) { writePfm(path, drawing.frame.depth); });
  outputs.add("--ids", common.idsFile, [&](const std::string& path) { writePgm(path, drawing.frame.ids); });
  outputs.add("--stats", common.statsFile, [&](const std::string& path) { writeFile(path, toJson(drawing.stats)); });
  outputs.add("-o", pictureFile(common, files[0].path), [&](const std::string& path) { writePng(path, drawing.frame.color); });
  std::vector<std::string> inputs;
  for (const MeshArgument& file : files) inputs.push_back(file.path);
  for (const std::string& input : inputs) checkReadable(input);
  outputs.check(inputs);

  auto progress = std::make_unique<Progress>(!common.quiet);
  progress->phase("reading " + inputs[0]);
  limitMemory(common.memoryBytes);
  std::optional<ScadExport> scad;
  Model model = readModel(options, kind, files, scad);
  const double loadMs = millisecondsSince(start);
  progress->phase("drawing " + inputs[0]);
  try {
    drawing = draw(model, options);
  } catch (const Error& error) {
    // What core finds at fault in a scene it cannot name by its file.
    if (error.code() != ExitCode::Input) throw;
    failInput("{}: {}", inputs[0], error.what());
  }
  if (scad) {
    const std::vector<std::string> more = scad->finish();
    model.warnings.insert(model.warnings.end(), more.begin(), more.end());
  }
  progress.reset();
  if (!common.quiet) {
    for (const std::string& warning : model.warnings) fmt::print(stderr, "copeel: warning: {}\n", warning);
    if (drawing.stats.triangles == 0) fmt::print(stderr, "copeel: warning: {}: there is nothing to draw\n", inputs[0]);
  }
  drawing.stats.loadMs = loadMs;
  drawing.stats.memoryBytes = peakMemoryBytes();
  drawing.stats.totalMs = millisecondsSince(start);
  Threads(common.threads).execute([&] { outputs.write(); });
}

}  // namespace

void addCommand(CLI::App& program) {
  CLI::App* command = program.add_subcommand("csg", "a CSG model (.scad, .csg or meshes) to a picture");
  const auto options = std::make_shared<CommandOptions>();
  addOptions(*command, *options);
  command->callback([options] { run(*options); });
}

}  // namespace copeel::csg
