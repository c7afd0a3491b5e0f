#include "apps/bench/peer_vtk.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <numbers>
#include <sstream>

#include <nlohmann/json.hpp>

#include "apps/bench/deadline.h"
#include "apps/bench/measure.h"
#include "apps/csg/process.h"
#include "core/error.h"
#include "core/output_file.h"
#include "vtk_script.h"

namespace copeel::bench {
namespace {

using Json = nlohmann::json;

// 24 layers of it differ from 23 by more than a level of 255, so that a picture of 8 bits tells the number.
constexpr double kAlpha = 0.08;

std::string objOf(const Mesh& mesh) {
  std::string text;
  for (const glm::dvec3& v : mesh.vertices) fmt::format_to(std::back_inserter(text), "v {} {} {}\n", v.x, v.y, v.z);
  for (const glm::uvec3& t : mesh.triangles) fmt::format_to(std::back_inserter(text), "f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

// The word of the log that says why: its last line.
std::string lastLine(const std::string& path) {
  std::ifstream log(path);
  std::string line, last;
  while (std::getline(log, line)) {
    if (!line.empty()) last = line;
  }
  return last;
}

Json jsonOf(const VtkJob& job, const View& view, const std::string& mesh) {
  const glm::dvec3 up = -view.down;
  return {{"mesh", mesh},
          {"copies", job.copies},
          {"alpha", kAlpha},
          {"width", view.width},
          {"height", view.height},
          {"frames", job.frames},
          {"enough_ms", kEnoughMs},
          {"eye", {view.eye.x, view.eye.y, view.eye.z}},
          {"forward", {view.forward.x, view.forward.y, view.forward.z}},
          {"up", {up.x, up.y, up.z}},
          {"degrees", 2 * std::atan(0.5 * view.height * glm::length(view.down)) * 180 / std::numbers::pi}};
}

// VTK of Debian wants an X server; xvfb-run lends one.
std::vector<std::string> commandOf(const std::string& folder) {
  std::vector<std::string> words;
  const std::string python = std::filesystem::exists("/usr/bin/python3") ? "/usr/bin/python3" : "python3";   // packages of the system are the system's Python's
  if (!std::getenv("DISPLAY")) words = {"xvfb-run", "-a"};
  for (const std::string& word : {python, folder + "/vtk_peeling.py", folder + "/job.json", folder + "/result.json"}) words.push_back(word);
  return words;
}

// Least time of ours, and the fragments of the scene.
std::pair<double, std::uint64_t> tileOf(const BenchScene& scene, const View& view, int frames, int threads) {
  oit::RenderOptions options;
  options.threads = threads;
  options.lit = false;
  oit::Renderer renderer(scene.parts, options);
  double least = 1e300;
  renderer.draw(view);
  const Deadline deadline(kEnoughMs);
  for (int i = 0; i < frames || deadline.leftMs() > 0; ++i) {
    const Deadline frame;
    renderer.draw(view);
    least = std::min(least, frame.passedMs());
  }
  return {least, renderer.stats().fragments};
}

}  // namespace

std::optional<PeerEntry> runVtk(const VtkJob& job, std::string& note) {
  const csg::TemporaryFolder folder(csg::systemTemporaryFolder());
  const std::string mesh = folder.path() + "/mesh.obj";
  const BenchScene scene = copies(*job.mesh, job.copies, "");
  const View view = viewOf(scene, boundingBox(*job.mesh), job.width, job.height);
  writeFile(folder.path() + "/vtk_peeling.py", kVtkScript);
  writeFile(mesh, objOf(*job.mesh));
  writeFile(folder.path() + "/job.json", jsonOf(job, view, mesh).dump());
  std::vector<csg::Command> command(1);
  command[0] = {commandOf(folder.path()), folder.path() + "/log"};
  try {
    csg::runAll(command, 1);
  } catch (const Error& error) {
    note = fmt::format("VTK was not run: {}.", error.what());
    return {};
  }
  std::ifstream file(folder.path() + "/result.json");
  const Json result = file && command[0].exitCode == 0 ? Json::parse(file, nullptr, false) : Json();
  if (!result.is_object()) {
    note = fmt::format("VTK was not run: it wants python3 with vtk (Debian: python3-vtk9) and an X server or xvfb-run; it said: {}.", lastLine(folder.path() + "/log"));
    return {};
  }
  auto ms = result["ms"].get<std::vector<double>>();
  std::sort(ms.begin(), ms.end());
  const auto [tileMs, fragments] = tileOf(scene, view, job.frames, job.threads);
  note = "VTK: dual depth peeling, all peels, unlit, opacity 0.08, the same mesh and camera, after one frame to warm up; R_h told from its picture of 8 bits, to about a per cent.";
  return PeerEntry{"VTK " + result["version"].get<std::string>(), job.copies, ms.front(), ms[ms.size() / 2], fragments ? result["layers"].get<double>() / double(fragments) : 1, tileMs};
}

}  // namespace copeel::bench
