#include "apps/command/make_picture.h"

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <system_error>

#include "apps/command/progress.h"
#include "core/error.h"
#include "core/image/write_image.h"
#include "core/methods/method.h"
#include "core/output_file.h"
#include "core/parallel.h"

namespace copeel {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

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

// What core finds at fault in a scene it cannot name by its file.
void drawNamed(const PictureSteps& steps, Stats& stats) {
  try {
    steps.draw(stats);
  } catch (const Error& error) {
    if (error.code() != ExitCode::Input) throw;
    failInput("{}: {}", steps.inputs.front(), error.what());
  }
}

}  // namespace

std::string asPath(const std::string& name) { return name.starts_with('-') ? "./" + name : name; }

void makePicture(const CommonOptions& options, const PictureSteps& steps, Outputs outputs, const Image<Rgb8>& color) {
  const auto start = Clock::now();
  const std::string& first = steps.inputs.front();
  if (!options.lit && !options.lights.empty()) failUsage("--light lights what --shading none leaves plain");
  // A view that cannot be is refused before anything is read.
  viewOf(options.camera, Box{{0, 0, 0}, {1, 1, 1}});

  Stats stats;
  outputs.add("--stats", options.statsFile, [&](const std::string& path) { writeFile(path, toJson(stats)); });
  outputs.add("-o", pictureFile(options, first), [&](const std::string& path) { writePng(path, color); });
  for (const std::string& input : steps.inputs) checkReadable(input);
  outputs.check(steps.inputs);

  auto progress = std::make_unique<Progress>(!options.quiet);
  progress->phase("reading " + first);
  limitMemory(options.memoryBytes);
  std::vector<std::string> warnings = steps.read();
  const double loadMs = millisecondsSince(start);
  progress->phase("drawing " + first);
  drawNamed(steps, stats);
  if (steps.finish) {
    const std::vector<std::string> more = steps.finish();
    warnings.insert(warnings.end(), more.begin(), more.end());
  }
  progress.reset();
  if (!options.quiet) {
    for (const std::string& warning : warnings) fmt::print(stderr, "copeel: warning: {}\n", warning);
    if (const MethodInfo* method = findMethod(stats.method); method && method->robust && stats.overflow > 0) {
      fmt::print(stderr, "copeel: warning: --method {}: {} fragments found no room and are missing\n", stats.method, stats.overflow);
    }
    if (stats.triangles == 0) fmt::print(stderr, "copeel: warning: {}: there is nothing to draw\n", first);
  }
  stats.loadMs = loadMs;
  stats.memoryBytes = peakMemoryBytes();
  stats.totalMs = millisecondsSince(start);
  Threads(options.threads).execute([&] { outputs.write(); });
}

}  // namespace copeel
