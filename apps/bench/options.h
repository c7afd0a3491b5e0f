// What is asked of `copeel bench`, and its parts.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "apps/bench/method_runs.h"
#include "core/scene/camera.h"

namespace copeel::bench {

struct Options {
  std::vector<std::string> scenes, methods, sizes, parts;
  std::string reportFolder, table, dataFolder, backend = "auto", depthSource = "planes";
  CameraOptions camera;             // of mesh files
  int copies = 4, frames = 3, threads = 0;
  double seconds = 160;             // that all parts together may take
  std::uint32_t k = 8;
  bool json = false, markdown = false, quiet = false, noPeer = false;
};

// A part, what it is, and its share of the time.
struct Part {
  std::string_view name, title;
  double weight;
};
inline constexpr std::array<Part, 10> kParts = {{{"scenes", "every method on every scene", 50},
                                                 {"resolution", "time over resolution", 16},
                                                 {"coplanarity", "time over coplanarity", 16},
                                                 {"depth", "time over depth complexity", 12},
                                                 {"culling", "passes with and without +cull", 8},
                                                 {"memory", "memory over fragments", 8},
                                                 {"table2011", "the table of the 2011 poster", 8},
                                                 {"table2013", "table 1 of the 2013 paper, measured", 6},
                                                 {"speed", "the limits of speed at 1280 x 720", 30},
                                                 {"peers", "VTK's dual depth peeling", 10}}};

// The parts asked for, in the order above: by --parts, else those that make sense with what is given. Throws Error{Usage}: no such part.
std::vector<Part> chosenParts(const Options& options);
std::vector<MethodRun> chosenMethods(const Options& options);           // of --methods, --backend and --depth-source
std::vector<std::array<int, 2>> chosenSizes(const Options& options);

}  // namespace copeel::bench
