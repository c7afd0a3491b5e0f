// Methods on one scene at one size: drawn in turns, so that what disturbs the machine disturbs all, and compared with the reference.
//
// A frame is the whole way from a view to colours and depths in memory, the same for every method and back end. The reference is the cpu back end's
// `tile` with every order of depths decided exactly; tests prove that one against exact references which the program itself does not link.
// Methods of few passes come first; one that, by its formula and the time of a pass so far, would outlast the budget is left out, and its entry says so.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "apps/bench/compare.h"
#include "apps/bench/method_runs.h"
#include "apps/bench/scenes.h"
#include "apps/bench/shape.h"

namespace copeel::bench {

// Of one method in one scene: then its timed frames end.
inline constexpr double kEnoughMs = 1500;

struct MeasureOptions {
  std::vector<MethodRun> methods;
  int frames = 3;                        // timed; fewer where the budget ends
  int threads = 0;
  double budgetMs = std::numeric_limits<double>::infinity();
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
  Stats stats;                           // passes, bytes, overflow of the last frame; fragments and coplanar pixels as the method's source of depth has them
  FrameError error;
  std::string picture, errorMap;         // file names
  std::string failure;                   // why there is nothing of it: the machine
  std::string leftOut;                   // or its time

  bool measured() const { return failure.empty() && leftOut.empty(); }
};

std::vector<Entry> measureScene(const BenchScene& scene, int width, int height, const MeasureOptions& options);

// Times alone, of pictures alone (no depth, no floats): without a reference, counts and errors.
std::vector<Entry> timeScene(const BenchScene& scene, int width, int height, const MeasureOptions& options);

// "f2b+cull" as part of a file's name, too.
std::string fileNameOf(const std::string& method);

}  // namespace copeel::bench
