// The real openscad draws a box, we cast our rays at the same box: the silhouettes must agree in every pixel that is not within
// openscad's rounding (float32 matrices, 1/256 pixel snapping) of the silhouette.
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include "core/image/image.h"
#include "core/scene/camera.h"

namespace copeel {
namespace {

namespace fs = std::filesystem;

const Box kBox{{-5, 10, -3}, {25, 20, 12}};
constexpr double kEdgeStep = 1.0 / 64;   // pixels; a pixel is an edge pixel when moving its sample by this much changes its answer

struct Case {
  std::string arguments;
  CameraOptions options;
};

Case makeCase(std::vector<double> camera, int width, int height, bool viewAll, bool autoCenter, bool perspective) {
  Case result{fmt::format("--imgsize={},{} --projection={}", width, height, perspective ? "p" : "o"),
              {std::move(camera), viewAll, autoCenter, perspective, width, height}};
  if (!result.options.camera.empty()) result.arguments += fmt::format(" --camera={}", fmt::join(result.options.camera, ","));
  if (viewAll) result.arguments += " --viewall";
  if (autoCenter) result.arguments += " --autocenter";
  return result;
}

std::vector<Case> allCases() {
  const std::vector<std::vector<double>> cameras = {
      {},                                  // the default
      {0, 0, 0, 55, 0, 25, 140},           // openscad's window at its start
      {10, 15, 5, 0, 0, 0, 120},           // top
      {10, 15, 5, 90, 0, 90, 90},          // right side
      {3, 2, 1, 33.3, 17.7, 211.1, 160},   // all three turns
      {3, 2, 1, -20, 400, -75, 160},       // angles out of 0 … 360
      {60, -70, 80, 10, 15, 5},            // eye and centre
      {-40, 90, -30, 8, 12, 2},            // from below and behind
      {10, 15, 100, 10, 15, 0},            // straight down
      {10, 15, -100, 10, 15, 0},           // straight up
      {10.001, 15, 100, 10, 15, 0},        // almost straight down: z is up again
  };
  std::vector<Case> cases;
  for (const auto& camera : cameras) {
    cases.push_back(makeCase(camera, 512, 512, false, false, true));
    cases.push_back(makeCase(camera, 400, 250, true, false, true));
    cases.push_back(makeCase(camera, 250, 400, true, true, false));
    cases.push_back(makeCase(camera, 333, 221, false, true, false));
  }
  return cases;
}

// Whether the ray through (x + dx, y + dy) meets the box, by clipping the ray to the box's three slabs.
bool hits(const View& view, double u, double v) {
  const glm::dvec3 across = u * view.right + v * view.down;
  const glm::dvec3 origin = view.perspective ? view.eye : view.eye + across;
  const glm::dvec3 direction = view.perspective ? view.forward + across : view.forward;
  double enter = view.perspective ? 0 : -INFINITY, leave = INFINITY;
  for (int axis = 0; axis < 3; ++axis) {
    if (direction[axis] == 0) {
      if (origin[axis] < kBox.min[axis] || origin[axis] > kBox.max[axis]) return false;
      continue;
    }
    const double a = (kBox.min[axis] - origin[axis]) / direction[axis], b = (kBox.max[axis] - origin[axis]) / direction[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave;
}

Image<Rgb8> readWithLibpng(const fs::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  if (!png_image_begin_read_from_file(&header, path.c_str())) return {};
  header.format = PNG_FORMAT_RGB;
  Image<Rgb8> image(static_cast<int>(header.width), static_cast<int>(header.height));
  png_image_finish_read(&header, nullptr, image.pixels.data(), 0, nullptr);
  return image;
}

struct Difference {
  int covered = 0, edge = 0, edgeWrong = 0, wrong = 0;   // pixels
};

Difference compare(const Image<Rgb8>& theirs, const View& view) {
  const Rgb8 background{255, 255, 229};
  Difference result;
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      const double u = x + 0.5 - view.width / 2.0, v = y + 0.5 - view.height / 2.0;
      const bool ours = hits(view, u, v);
      bool edge = false;
      for (const auto& [du, dv] : {std::pair{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}) {
        edge |= hits(view, u + du * kEdgeStep, v + dv * kEdgeStep) != ours;
      }
      const bool differs = ours == (theirs.at(x, y) == background);
      result.covered += ours;
      result.edge += edge;
      result.edgeWrong += edge && differs;
      result.wrong += !edge && differs;
    }
  }
  return result;
}

// One X server for all pictures: starting it costs more than drawing them.
bool drawAll(const fs::path& folder, const std::vector<Case>& cases) {
  std::ofstream(folder / "box.scad") << fmt::format("translate([{},{},{}]) cube([{},{},{}]);\n", kBox.min.x, kBox.min.y, kBox.min.z,
                                                     kBox.max.x - kBox.min.x, kBox.max.y - kBox.min.y, kBox.max.z - kBox.min.z);
  std::ofstream script(folder / "draw.sh");
  script << "cd '" << folder.string() << "' || exit 1\n";
  for (std::size_t i = 0; i < cases.size(); ++i) script << fmt::format("openscad -q {} -o {}.png box.scad\n", cases[i].arguments, i);
  script.close();
  return std::system(fmt::format("xvfb-run -a sh '{}' >/dev/null 2>&1", (folder / "draw.sh").string()).c_str()) == 0;
}

TEST(CameraAgainstOpenscad, SilhouettesAgreeOffEdges) {
  if (std::system("command -v openscad >/dev/null && command -v xvfb-run >/dev/null") != 0) GTEST_SKIP() << "no openscad or no xvfb-run";
  const fs::path folder = fs::temp_directory_path() / fmt::format("copeel-camera-{}", getpid());
  fs::create_directories(folder);
  const std::vector<Case> cases = allCases();
  ASSERT_TRUE(drawAll(folder, cases));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    SCOPED_TRACE(cases[i].arguments);
    const Image<Rgb8> theirs = readWithLibpng(folder / fmt::format("{}.png", i));
    ASSERT_EQ(theirs.width, cases[i].options.width);
    ASSERT_EQ(theirs.height, cases[i].options.height);
    const Difference difference = compare(theirs, viewOf(cases[i].options, kBox));
    EXPECT_GT(difference.covered, 1000);   // else the case shows nothing and proves nothing
    EXPECT_EQ(difference.wrong, 0) << "of " << difference.covered << " covered";
    RecordProperty(fmt::format("edge_pixels_{}", i), fmt::format("{} of {} differ", difference.edgeWrong, difference.edge));
  }
  fs::remove_all(folder);
}

}  // namespace
}  // namespace copeel
