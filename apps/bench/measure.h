// Methods on one scene at one size: drawn in turns, so that what disturbs the machine disturbs all, and compared with the reference.
//
// A frame is the whole way from a view to colours and depths in memory, the same for every method and back end. The reference is the cpu back end's
// `tile` with every order of depths decided exactly; tests prove that one against exact references which the program itself does not link.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/compare.h"
#include "apps/bench/scenes.h"

namespace copeel::bench {

// A method as it is asked for: with its modifiers.
struct MethodRun {
  const MethodInfo* method;
  MethodOptions options;
  std::string label;                     // what it is called on the command line; with its back end where both have the name
};

struct MeasureOptions {
  std::vector<MethodRun> methods;
  int frames = 3;                        // timed; fewer of methods that take seconds
  int threads = 0;
  std::string pictureFolder;             // receives SCENE-METHOD.png and SCENE-METHOD-error.png; empty: none
};

// What a method did on a scene.
struct Entry {
  std::string scene, method, backend;
  bool robust = false;
  int width = 0, height = 0;
  double parameter = 0;                  // of a sweep: copies, shells
  double minMs = 0, medianMs = 0;
  int frames = 0;
  Stats stats;                           // passes, bytes, fragments, overflow, of the last frame
  FrameError error;
  std::string picture, errorMap;         // file names
  std::string failure;                   // why there is nothing of it; else empty
};

std::vector<Entry> measureScene(const BenchScene& scene, int width, int height, const MeasureOptions& options);

// The runs that a name on the command line means: one on each back end that has the method, of those that `backend` (cpu, gl, auto: both) admits. Buffers hold
// K fragments. Throws Error{Usage} as chooseMethod() does.
std::vector<MethodRun> runsOf(std::string_view backend, std::string_view text, std::uint32_t k);

// "f2b+cull" as part of a file's name, too.
std::string fileNameOf(const std::string& method);

}  // namespace copeel::bench
