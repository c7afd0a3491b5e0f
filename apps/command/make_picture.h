// The steps that every picture-making sub-command goes through around its own reading and drawing: what can be refused is refused first,
// then it reads, draws as often as asked, warns, and writes everything at once.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "apps/command/common_options.h"
#include "apps/command/outputs.h"
#include "core/image/image.h"
#include "core/metrics/stats.h"

namespace copeel {

struct PictureSteps {
  std::vector<std::string> inputs;                  // paths of what is read
  std::function<std::vector<std::string>()> read;   // returns warnings, one line each
  std::function<void(Stats&)> draw;                 // prepares, and draws as drawFrames does
  std::function<std::vector<std::string>()> finish; // if any: what a reader has to say only now; returns more warnings
};

// `outputs` holds what the command writes of its own; --stats and the picture come after it, the picture last: once it is there, so is
// everything else. `color` is filled by `draw`.
void makePicture(const CommonOptions& options, const PictureSteps& steps, Outputs outputs, const Image<Rgb8>& color);

// A name with a leading dash is a file all the same, to us and to the programs we hand it to.
std::string asPath(const std::string& name);

// `renderer.draw(view)` as often as --frames asks: the last frame, and the times of all.
template <class Renderer>
auto drawFrames(Renderer& renderer, const CommonOptions& options, Stats& stats) {
  using Clock = std::chrono::steady_clock;
  const View view = viewOf(options.camera, renderer.bounds());
  decltype(renderer.draw(view)) frame;
  std::vector<double> times;
  for (int i = 0; i < options.frames; ++i) {
    const auto start = Clock::now();
    frame = renderer.draw(view);
    times.push_back(std::chrono::duration<double, std::milli>(Clock::now() - start).count());
  }
  std::sort(times.begin(), times.end());
  if constexpr (requires { renderer.measure(); }) {
    if (!options.statsFile.empty()) renderer.measure();
  }
  stats = renderer.stats();
  stats.frameMinMs = times.front();
  stats.frameMedianMs = (times[times.size() / 2] + times[(times.size() - 1) / 2]) / 2;
  return frame;
}

}  // namespace copeel
