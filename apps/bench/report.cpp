// The report as text.
#include "apps/bench/report.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <thread>

#include <fmt/format.h>

#include "core/error.h"
#if COPEEL_GL
#include "core/gl/context.h"
#endif

namespace copeel::bench {
namespace {

// "; gl: llvmpipe (LLVM 15.0.6, 256 bits)", or nothing where there is no GL.
std::string glLine() {
#if COPEEL_GL
  try {
    return "; gl: " + gl::Context().renderer();
  } catch (const Error&) {
  }
#endif
  return "";
}

}  // namespace

std::string decibels(double psnr) { return std::isfinite(psnr) ? fmt::format("{:.1f}", psnr) : "∞"; }
std::string lengthOf(double depth) { return std::isfinite(depth) ? fmt::format("{:.2g}", depth) : "∞"; }

// "AMD EPYC 7B13, 2 cores; gl: …".
std::string machineLine() {
  std::ifstream info("/proc/cpuinfo");
  std::string line, name = "a processor that does not say its name";
  while (std::getline(info, line)) {
    const std::size_t colon = line.find(": ");
    if (!line.starts_with("model name") || colon == std::string::npos) continue;
    name = line.substr(colon + 2);
    break;
  }
  return fmt::format("{}, {} cores{}", name, std::thread::hardware_concurrency(), glLine());
}

std::string toText(const std::vector<Entry>& entries) {
  std::size_t width = 16;
  for (const Entry& e : entries) width = std::max(width, e.method.size());
  std::string text = fmt::format("{:<8} {:<{}} {:>9} {:>9} {:>6} {:>8} {:>7} {:>9} {:>7} {:>6} {:>8}\n", "scene", "method", width, "ms least", "median", "passes", "MiB", "R_h", "overflow", "wrong",
                                 "PSNR", "depth");
  for (const Entry& e : entries) {
    text += fmt::format("{:<8} {:<{}} ", e.scene, e.method, width);
    if (!e.measured()) text += e.failure + e.leftOut + "\n";
    else text += fmt::format("{:>9.2f} {:>9.2f} {:>6} {:>8.2f} {:>7.4f} {:>9} {:>7} {:>6} {:>8}\n", e.minMs, e.medianMs, e.stats.passes, double(e.stats.methodBytes) / (1 << 20), e.stats.rh(),
                             e.stats.overflow, e.error.wrong, decibels(e.error.psnr), lengthOf(e.error.depth));
  }
  return text;
}

std::vector<DepthSources> depthSourcesOf(const std::vector<Entry>& entries) {
  std::vector<DepthSources> pairs;
  for (const Entry& hardware : entries) {
    const std::size_t suffix = hardware.method.find(" (hardware depth)");
    if (suffix == std::string::npos || !hardware.measured()) continue;
    const auto planes = std::find_if(entries.begin(), entries.end(), [&](const Entry& e) { return e.measured() && e.method == hardware.method.substr(0, suffix); });
    if (planes != entries.end()) pairs.push_back({&*planes, &hardware});
  }
  return pairs;
}

std::string depthSourcesToText(const Report& report) {
  std::string text;
  for (const SceneRun& scene : report.scenes) {
    for (const auto& [planes, hardware] : depthSourcesOf(scene.entries)) {
      text += fmt::format("{:<8} {:<8} {:>7} {:>7}  {:>7.4f} {:>7.4f}  {:>7.4f} {:>7.4f}\n", scene.name, planes->method, planes->error.wrong, hardware->error.wrong, planes->stats.rh(),
                          hardware->stats.rh(), planes->stats.cp(), hardware->stats.cp());
    }
  }
  if (text.empty()) return "";
  return fmt::format("Depth of the face's plane (ours) and of the rasterizer (as in the papers)\n{:<8} {:<8} {:>7} {:>7}  {:>7} {:>7}  {:>7} {:>7}\n", "scene", "method", "wrong", "hardw.", "R_h",
                     "hardw.", "C_p", "hardw.") + text;
}

}  // namespace copeel::bench
