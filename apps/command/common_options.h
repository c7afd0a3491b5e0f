// The options every picture-making sub-command has; their names and meanings are a contract that scripts depend on.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "core/methods/draw.h"
#include "core/scene/camera.h"

namespace CLI {
class App;
}

namespace copeel {

struct CommonOptions {
  CameraOptions camera;
  std::string output;                                 // -o
  std::string backend = "auto";
  std::string method = "auto";                        // with modifiers: what chooseMethod() takes
  MethodOptions methodOptions;
  int threads = 0;                                    // 0: all cores
  std::uint64_t memoryBytes = 0;                      // 0: no limit
  int samples = 1;                                    // per pixel
  double coplanarTolerance = 0;                       // model units; 0: from the scene
  std::optional<std::array<double, 3>> background;    // 0 … 255
  bool lit = true;
  std::string depthFile, idsFile, statsFile;
  int frames = 1;
  bool quiet = false;
};

// Declares the options; `options` must live as long as the command does, and is filled while the command line is read. Values that make no sense throw Error{Usage}.
void addCommonOptions(CLI::App& command, CommonOptions& options);

// Where the picture goes: -o, or the first input's name in the current folder with .png. Throws Error{Usage} on another ending.
std::string pictureFile(const CommonOptions& options, const std::string& input);

// Holds the data memory of the process, and that of each program it runs, to the limit from now on: past it, allocations fail and the
// program ends with exit code 3. Called before anything is read.
void limitMemory(std::uint64_t bytes);

}  // namespace copeel
