// gl_methods: the robust methods of the gl back end beside a textbook linked list (plain_list.h), and `auto` beside the best of them.
//
// All methods draw a scene in turns, in one context, from one camera; minima are compared. A time is that of the passes on the device, from the method's first
// call to its last pixel: what an application does before and after is the same for all. `empty` is a method that does nothing. A view is drawn
// twice before it is timed, so that programs are compiled and buffers have grown.
#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <ctime>
#include <memory>

#include <CLI/CLI.hpp>
#include <fmt/ranges.h>

#include "apps/bench/scenes.h"
#include "apps/command/parse_values.h"
#include "apps/copeel/heap.h"
#include "apps/oit/over_buffers.h"
#include "bench/plain_list.h"
#include "bench/table.h"
#include "core/error.h"
#include "core/gl/renderer.h"
#include "core/scene/camera.h"

namespace copeel::bench {
namespace {

constexpr std::uint32_t kPlainNodes = 128;        // a pixel, at most, of the plain list: its guess is right
constexpr unsigned kScreens = 60;                 // quads of the scene "screens"
constexpr double kEnoughMs = 4000;                // of one method in one view
constexpr int kFramesOfATurn = 2;                 // in the first a method finds the caches as others left them
constexpr int kLeastFrames = 4;                   // in the first ones buffers may have to grow again: `auto` lets go of all when it looks at a view

struct Options {
  std::vector<std::string> scenes, methods, sizes;
  int copies = 4, frames = 15;
  std::string memory;
  bool processorTime = false, hardwareDepth = false, moving = false;
};

void declare(CLI::App& app, Options& options) {
  app.add_option("--scenes", options.scenes, "screens, a name of `copeel bench`, or a mesh file, FILE*12 for twelve coincident ones (all generated ones)")->delimiter(',');
  app.add_option("--methods", options.methods, "(all robust ones of a single look at the scene)")->delimiter(',');
  app.add_option("--sizes", options.sizes, "pixels (640,360 1280,720)")->type_name("W,H");
  app.add_option("--copies", options.copies, "of the generated scenes that have them")->capture_default_str();
  app.add_option("--frames", options.frames, "of each method")->capture_default_str();
  app.add_option("--memory", options.memory, "bytes that a method may use");
  app.add_flag("--processor-time", options.processorTime, "of all threads together, for a machine that has other work");
  app.add_flag("--hardware-depth", options.hardwareDepth, "the rasterizer's depths");
  app.add_flag("--moving", options.moving, "a new view each frame: what is found out once a view is paid for each time");
}

// Quads as large as the picture, one behind the other.
BenchScene screens() {
  BenchScene scene{"screens", "quads over the whole picture", {}};
  scene.camera.camera = {2.5, 0.01, 0.02, 0, 0, 0};   // eye, centre: from where they cover the picture
  auto quad = std::make_shared<Mesh>();
  for (int i = 0; i < 4; ++i) quad->vertices.emplace_back(0, i & 1 ? 1 : -1, i & 2 ? 1 : -1);
  quad->triangles = {{0, 1, 3}, {0, 3, 2}};
  for (unsigned i = 0; i < kScreens; ++i) {
    glm::dmat4 place(1.0);
    place[3][0] = -0.001 * i;
    scene.parts.push_back({quad, {10.0f + 4 * float(i), 200, 90, 0.1f}, {}, place});
  }
  return scene;
}

BenchScene sceneNamed(const std::string& name, int copies) {
  if (name == "screens") return screens();
  const std::size_t star = name.find('*');
  if (star == std::string::npos) return sceneOf(name, static_cast<std::size_t>(std::find(sceneNames().begin(), sceneNames().end(), name) == sceneNames().end() ? 1 : copies));
  const std::string digits = name.substr(star + 1);
  BenchScene scene = sceneOf(name.substr(0, star), static_cast<std::size_t>(parseNumber(digits, "--scenes")));
  scene.name += fmt::format("*{}", digits);
  return scene;
}

View viewNamed(const BenchScene& scene, const Box& bounds, int width, int height) {
  if (scene.name != "screens") return viewOf(scene, bounds, width, height);
  CameraOptions camera;
  camera.width = width, camera.height = height;
  camera.camera = {1, 0.01, 0.02, 0, 0.01, 0.02};
  return copeel::viewOf(camera, bounds);
}

MethodCounts drawNothing(gl::Frame&, const MethodOptions&) { return {}; }

struct Contestant {
  std::string name;
  DrawMethod draw = nullptr;
  MethodOptions options;
  double bestMs = HUGE_VAL, spentMs = 0;
  gl::FrameCounts counts;
  std::vector<std::uint32_t> result;
};

std::vector<Contestant> contestants(const Options& options) {
  MethodOptions ours;
  ours.hardwareDepth = options.hardwareDepth;
  if (!options.memory.empty()) ours.memoryBytes = parseBytes(options.memory, "--memory");
  MethodOptions plain = ours;
  plain.k = kPlainNodes;
  std::vector<Contestant> all{{"empty", drawNothing, ours, HUGE_VAL, 0, {}, {}}, {"plain", drawPlainList, plain, HUGE_VAL, 0, {}, {}}};
  const std::vector<std::string> standard = {"ll", "fab", "bun-ll", "sb", "hybrid", "auto"};
  for (const std::string& name : options.methods.empty() ? standard : options.methods) {
    const MethodInfo* method = findMethod(name, "gl");
    if (!method || !method->draw) failUsage("--methods: '{}' is not a method of the gl back end", name);
    all.push_back({name, method->draw, ours, HUGE_VAL, 0, {}, {}});
  }
  return all;
}

double doubleOf(const std::uint32_t* words) { return std::bit_cast<double>(std::uint64_t{words[1]} << 32 | words[0]); }

double nowMs(bool processorTime) {
  if (processorTime) return 1000.0 * double(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// A scene on the device with everything that is not timed.
class Subject {
 public:
  Subject(const BenchScene& bench, const Options& options)
      : options_(options), bench_(bench), scene_(objectsOf(bench)), planes_(scene_, 0),
        renderer_(scene_, planes_, options.hardwareDepth ? gl::DepthSource::Hardware : gl::DepthSource::Planes) {
    for (const oit::Part& part : bench.parts) {
      if (part.faceColors.empty()) tables_.addObject(part.color);
      else tables_.addObject(part.faceColors);
    }
  }

  void setSize(int width, int height) {
    view_ = viewNamed(bench_, scene_.bounds(), width, height);
    tables_.shades = fold::shadesOf(planes_, view_, true);
    renderer_.setView(view_);
    renderer_.setFold(buffers_.upload(scene_, tables_, false));
  }
  double time(Contestant& contestant) {
    if (options_.moving) renderer_.frame().look.reset();
    const double start = nowMs(options_.processorTime);
    contestant.counts = renderer_.draw(contestant.draw, contestant.options);
    return nowMs(options_.processorTime) - start;
  }
  std::vector<std::uint32_t> result() const { return renderer_.result(); }

 private:
  static Scene objectsOf(const BenchScene& bench) {
    std::vector<Object> objects;
    for (const oit::Part& part : bench.parts) objects.push_back({part.mesh, part.worldFromObject});
    return Scene(std::move(objects));
  }

  const Options& options_;
  const BenchScene& bench_;
  Scene scene_;
  PlaneClasses planes_;
  fold::OverTables tables_;
  gl::Renderer renderer_;
  oit::OverBuffers buffers_;
  View view_;
};

std::vector<Contestant> race(Subject& subject, const Options& options) {
  std::vector<Contestant> all = contestants(options);
  for (Contestant& contestant : all) {
    for (int i = 0; i < 2; ++i) subject.time(contestant);
    contestant.result = subject.result();
  }
  for (int frame = 0; frame < options.frames; frame += kFramesOfATurn) {
    for (Contestant& contestant : all) {
      if (frame >= kLeastFrames && contestant.spentMs > kEnoughMs) continue;
      for (int more = 0; more < kFramesOfATurn; ++more) {
        const double ms = subject.time(contestant);
        contestant.bestMs = std::min(contestant.bestMs, ms);
        contestant.spentMs += ms;
      }
    }
  }
  return all;
}

// Same picture for all, or the time is worth nothing. Methods that take a group from both ends join two sums of doubles.
void checkResults(const std::vector<Contestant>& all, const std::string& scene) {
  constexpr double kRounding = 1e-9;   // of a level
  const std::vector<std::uint32_t>& plain = all[1].result;
  for (const Contestant& contestant : all) {
    const MethodInfo* method = findMethod(contestant.name, "gl");
    if (!method || !method->robust || contestant.counts.method.overflow > 0) continue;
    for (std::size_t at = 0; at < plain.size(); at += oit::kOverResultWords) {
      const std::uint32_t *words = contestant.result.data() + at, *wanted = plain.data() + at;
      bool same = std::equal(words + 8, words + oit::kOverResultWords, wanted + 8);
      for (int i = 0; i < 8 && wanted[9] > 0; i += 2) same = same && std::abs(doubleOf(words + i) - doubleOf(wanted + i)) <= kRounding;
      if (same) continue;
      failMachine("{}: {} draws another picture than the plain list, at pixel {}", scene, contestant.name, at / oit::kOverResultWords);
    }
  }
}

std::vector<std::string> rowOf(const std::string& scene, int width, int height, const std::vector<Contestant>& all) {
  std::vector<std::string> row{scene, fmt::format("{}x{}", width, height)};
  double best = HUGE_VAL, chosen = 0;
  std::string bestName, chosenName;
  for (const Contestant& contestant : all) {
    row.push_back(fmt::format("{:.2f}", contestant.bestMs));
    const MethodInfo* method = findMethod(contestant.name, "gl");
    if (contestant.name == "auto") chosen = contestant.bestMs, chosenName = contestant.counts.method.chosen;
    else if (method && method->robust && contestant.bestMs < best) best = contestant.bestMs, bestName = contestant.name;
  }
  row.insert(row.end(), {bestName, chosenName, chosen > 0 && best < HUGE_VAL ? fmt::format("{:+.0f} %", 100 * (chosen / best - 1)) : ""});
  return row;
}

void run(Options& options) {
  if (options.scenes.empty()) {
    options.scenes = sceneNames();
    options.scenes.push_back("screens");
  }
  if (options.sizes.empty()) options.sizes = {"640,360", "1280,720"};
  Table table;
  table.head = {"scene", "size"};
  table.wordColumns = 2;
  for (const Contestant& contestant : contestants(options)) table.head.push_back(contestant.name);
  table.head.insert(table.head.end(), {"best", "auto's", "behind"});
  for (const std::string& name : options.scenes) {
    const BenchScene scene = sceneNamed(name, options.copies);
    Subject subject(scene, options);
    for (const std::string& text : options.sizes) {
      const auto [width, height] = parseImageSize(text);
      subject.setSize(width, height);
      const std::vector<Contestant> all = race(subject, options);
      checkResults(all, scene.name);
      table.rows.push_back(rowOf(scene.name, width, height, all));
      }
  }
  fmt::print("{}", toText(table));
}

}  // namespace
}  // namespace copeel::bench

int main(int argc, char** argv) {
  copeel::keepHeap();   // as the program does
  CLI::App app("Robust methods of the gl back end beside a plain linked list, and auto beside the best of them: ms");
  copeel::bench::Options options;
  copeel::bench::declare(app, options);
  CLI11_PARSE(app, argc, argv);
  try {
    copeel::bench::run(options);
  } catch (const copeel::Error& error) {
    fmt::print(stderr, "gl_methods: {}\n", error.what());
    return static_cast<int>(error.code());
  }
}
