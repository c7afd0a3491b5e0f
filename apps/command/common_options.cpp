#include "apps/command/common_options.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <sys/resource.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "apps/command/outputs.h"
#include "apps/command/parse_values.h"
#include "core/error.h"

namespace copeel {
namespace {

constexpr int kMaxThreads = 1024;
constexpr int kMaxSamples = 256;         // per pixel; 8 bits of a channel show no more
constexpr int kMostBufferLength = 1024;   // fragments: 8 KB a pixel
constexpr int kMaxFrames = 1000000;

// An option whose text goes through one of our own parsers.
template <class Parse>
CLI::Option* addParsed(CLI::App& command, const std::string& name, const std::string& valueName, const std::string& help, Parse parse) {
  return command.add_option_function<std::string>(name, std::move(parse), help)->type_name(valueName);
}

template <class Number>
void addWhole(CLI::App& command, const std::string& name, Number& value, int least, int most, const std::string& help) {
  addParsed(command, name, "N", help, [&value, name, least, most](const std::string& text) {
    const double number = parseNumber(text, name);
    if (number < least || number > most || number != static_cast<int>(number)) {
      failUsage("{} takes a whole number from {} to {}, not {}", name, least, most, text);
    }
    value = static_cast<Number>(number);
  });
}

void addWord(CLI::App& command, const std::string& name, std::string& value, const std::string& words, const std::string& help) {
  addParsed(command, name, words, help, [&value, name, words](const std::string& text) {
    const std::string list = "|" + words + "|";
    if (text.empty() || text.find('|') != std::string::npos || list.find("|" + text + "|") == std::string::npos) {
      failUsage("{} takes one of {}, not '{}'", name, words, text);
    }
    value = text;
  });
}

void addCameraOptions(CLI::App& command, CameraOptions& camera) {
  addParsed(command, "--imgsize", "W,H", "size of the picture in pixels (512,512)", [&camera](const std::string& text) {
    const auto size = parseImageSize(text);
    camera.width = size[0];
    camera.height = size[1];
  });
  addParsed(command, "--camera", "NUMBERS", "translate x,y,z, rotate x,y,z, distance, or eye x,y,z, centre x,y,z",
            [&camera](const std::string& text) {
              camera.camera = parseNumbers(text, "--camera");
              if (camera.camera.size() != 6 && camera.camera.size() != 7) {
                failUsage("--camera takes 7 numbers (translate, rotate, distance) or 6 (eye, centre), not {}", camera.camera.size());
              }
            });
  command.add_flag("--viewall", camera.viewAll, "move the camera so that the whole model is seen; the default without --camera");
  command.add_flag("--autocenter", camera.autoCenter, "with --viewall: look at the model's centre");
  addParsed(command, "--projection", "o|p", "orthographic or perspective (p)",
            [&camera](const std::string& text) { camera.perspective = parseProjection(text); });
}

void addFileOptions(CLI::App& command, CommonOptions& options) {
  command.add_option("-o,--output", options.output, "the picture, a PNG (the input's name in the current folder); - is standard output")
      ->type_name("FILE.png");
  command.add_option("--depth", options.depthFile, "distance along the view axis, +inf where nothing is seen")->type_name("FILE.pfm");
  command.add_option("--ids", options.idsFile, "1 + index of the visible leaf, 0 for nothing")->type_name("FILE.pgm");
  command.add_option("--stats", options.statsFile, "what was counted and timed")->type_name("FILE.json");
}

}  // namespace

void addCommonOptions(CLI::App& command, CommonOptions& options) {
  addFileOptions(command, options);
  addCameraOptions(command, options.camera);
  addWord(command, "--backend", options.backend, "cpu|gl|auto", "where to draw (auto)");
  addParsed(command, "--method", "NAME", "how fragments are ordered: see copeel methods (auto)", [&options](const std::string& text) { options.method = text; });
  addWhole(command, "--buffer-length", options.methodOptions.k, 1, kMostBufferLength, "fragments in the buffers of kb, k-plus, f2b-fab and their like (8)");
  addParsed(command, "--depth-source", "planes|hardware", "of the gl back end: exact for each plane, or the rasterizer's, as in the papers (planes)",
            [&options](const std::string& text) {
              if (text != "planes" && text != "hardware") failUsage("--depth-source takes one of planes|hardware, not '{}'", text);
              options.methodOptions.hardwareDepth = text == "hardware";
            });
  addWhole(command, "--threads", options.threads, 1, kMaxThreads, "how many threads (all cores)");
  addParsed(command, "--memory", "BYTES", "the most data memory, such as 512M or 2G; where it is not enough, exit code 3",
            [&options](const std::string& text) { options.memoryBytes = options.methodOptions.memoryBytes = parseBytes(text, "--memory"); });
  addWhole(command, "--samples", options.samples, 1, kMaxSamples, "samples a pixel, for smooth edges (1)");
  addParsed(command, "--coplanar-tolerance", "LENGTH", "faces closer than this are one face, in model units (by the input's precision)",
            [&options](const std::string& text) {
              options.coplanarTolerance = parseNumber(text, "--coplanar-tolerance");
              if (options.coplanarTolerance < 0) failUsage("--coplanar-tolerance cannot be negative");
            });
  addParsed(command, "--background", "#rrggbb", "colour behind the model",
            [&options](const std::string& text) { options.background = parseColor(text, "--background"); });
  addParsed(command, "--shading", "lit|none", "openscad's light, or plain colours (lit)", [&options](const std::string& text) {
    if (text != "lit" && text != "none") failUsage("--shading takes one of lit|none, not '{}'", text);
    options.lit = text == "lit";
  });
  addWhole(command, "--frames", options.frames, 1, kMaxFrames, "draw so many times, for timing (1)");
  command.add_flag("-q,--quiet", options.quiet, "no warnings and no progress");
}

std::string pictureFile(const CommonOptions& options, const std::string& input) {
  namespace fs = std::filesystem;
  if (options.output.empty()) return fs::path(input).filename().replace_extension(".png").string();
  std::string ending = fs::path(options.output).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending != ".png" && !isStream(options.output)) failUsage("-o takes the name of a .png, not {}", options.output);
  return options.output;
}

void limitMemory(std::uint64_t bytes) {
  if (bytes == 0) return;
#ifdef __GLIBC__
  // What the heap holds in reserve (apps/copeel/heap.h) would be beyond the limit's reach.
  mallopt(M_TOP_PAD, 0);
  malloc_trim(0);
#endif
  struct rlimit limit = {};
  const bool known = getrlimit(RLIMIT_DATA, &limit) == 0;
  limit.rlim_cur = std::min<rlim_t>(bytes, limit.rlim_max);
  if (!known || setrlimit(RLIMIT_DATA, &limit) != 0) failMachine("cannot limit the memory to {} bytes", bytes);
}

}  // namespace copeel
