#include "bench/measure_frames.h"

#include <algorithm>
#include <chrono>

#include <nlohmann/json.hpp>

#include "apps/csg/read_model.h"
#include "core/scene/camera.h"

namespace copeel::bench {
namespace {

using Clock = std::chrono::steady_clock;

double msSince(Clock::time_point start) { return std::chrono::duration<double, std::milli>(Clock::now() - start).count(); }

template <class Work>
double msOf(Work work) {
  const auto start = Clock::now();
  work();
  return msSince(start);
}

// Repeats `work` up to `count` times within a budget, at least once.
template <class Work>
Times repeat(int count, double seconds, Work work) {
  std::vector<double> ms;
  const auto start = Clock::now();
  do ms.push_back(msOf(work));
  while (static_cast<int>(ms.size()) < count && msSince(start) < seconds * 1000);
  return timesOf(std::move(ms));
}

View defaultView(const Box& bounds) {
  CameraOptions camera;
  camera.width = kWidthPx;
  camera.height = kHeightPx;
  return viewOf(camera, bounds);
}

nlohmann::ordered_json json(const Times& times) { return {{"min", times.minMs}, {"median", times.medianMs}}; }
Times timesFrom(const nlohmann::json& json) { return {json.at("min"), json.at("median")}; }

}  // namespace

Times timesOf(std::vector<double> ms) {
  if (ms.empty()) return {};
  std::sort(ms.begin(), ms.end());
  return {ms.front(), (ms[ms.size() / 2] + ms[(ms.size() - 1) / 2]) / 2};
}

csg::RenderOptions renderOptions(const std::string& method, int threads) {
  csg::RenderOptions options;
  options.method = findMethod(method);
  options.threads = threads;
  return options;
}

FramePair::FramePair(const csg::Model& model, int threads)
    : zbuffer_(model, renderOptions("zbuffer", threads)), csg_(model, renderOptions("tile", threads)), view_(defaultView(csg_.bounds())) {}

FrameMeasurement measureFrames(const std::string& csgFile, const FrameLimits& limits) {
  FrameMeasurement result;
  csg::Model model;
  result.load = repeat(limits.frames, limits.seconds / 2, [&] { model = csg::readCsg(csgFile, {}); });
  result.prepare = repeat(limits.frames, limits.seconds / 2, [&] { csg::Renderer renderer(model, renderOptions("tile", limits.threads)); });

  // One frame of each warms the caches and is not counted.
  FramePair pair(model, limits.threads);
  pair.drawZbuffer();
  pair.drawCsg();
  std::vector<double> zbuffer, csg;
  const auto start = Clock::now();
  for (int i = 0; i < limits.frames && (i < kLeastFrames || msSince(start) < limits.seconds * 1000); ++i) {
    zbuffer.push_back(msOf([&] { pair.drawZbuffer(); }));
    csg.push_back(msOf([&] { pair.drawCsg(); }));
  }
  result.zbuffer = timesOf(std::move(zbuffer));
  result.csg = timesOf(std::move(csg));

  const Stats& stats = pair.stats();
  result.triangles = stats.triangles;
  result.leaves = stats.leaves;
  result.planeClasses = stats.planeClasses;
  result.fragments = stats.fragments;
  result.depthComplexityMax = stats.depthComplexityMax;
  result.decidedExactly = stats.decidedExactly;
  return result;
}

std::string toJson(const FrameMeasurement& m) {
  const nlohmann::ordered_json text{{"triangles", m.triangles},
                                    {"leaves", m.leaves},
                                    {"plane_classes", m.planeClasses},
                                    {"fragments", m.fragments},
                                    {"depth_complexity_max", m.depthComplexityMax},
                                    {"decided_exactly", m.decidedExactly},
                                    {"load_ms", json(m.load)},
                                    {"prepare_ms", json(m.prepare)},
                                    {"zbuffer_ms", json(m.zbuffer)},
                                    {"csg_ms", json(m.csg)}};
  return text.dump();
}

FrameMeasurement frameMeasurementOf(const std::string& text) {
  const nlohmann::json json = nlohmann::json::parse(text);
  FrameMeasurement m;
  m.triangles = json.at("triangles");
  m.leaves = json.at("leaves");
  m.planeClasses = json.at("plane_classes");
  m.fragments = json.at("fragments");
  m.depthComplexityMax = json.at("depth_complexity_max");
  m.decidedExactly = json.at("decided_exactly");
  m.load = timesFrom(json.at("load_ms"));
  m.prepare = timesFrom(json.at("prepare_ms"));
  m.zbuffer = timesFrom(json.at("zbuffer_ms"));
  m.csg = timesFrom(json.at("csg_ms"));
  return m;
}

}  // namespace copeel::bench
