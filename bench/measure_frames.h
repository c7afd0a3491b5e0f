// Times inside one process: reading, preparing, and frames by two methods in turn, so that both meet the same noise of the machine.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "apps/csg/render_csg.h"

namespace copeel::bench {

inline constexpr int kWidthPx = 1024;
inline constexpr int kHeightPx = 768;

struct Times {
  double minMs = 0, medianMs = 0;
};
Times timesOf(std::vector<double> ms);   // all 0 for an empty list

struct FrameLimits {
  int threads = 2;
  int frames = 25;              // pairs of frames, one by each method
  double seconds = 4;           // of frames, unless that is fewer than kLeastFrames pairs; reading and preparing get half of it each
};
inline constexpr int kLeastFrames = 3;

struct FrameMeasurement {
  std::uint64_t triangles = 0, leaves = 0, planeClasses = 0;
  std::uint64_t fragments = 0;             // met by the CSG frame
  std::uint64_t depthComplexityMax = 0, decidedExactly = 0;
  Times load, prepare, zbuffer, csg;

  double ratio() const { return zbuffer.minMs > 0 ? csg.minMs / zbuffer.minMs : 0; }
};

// A model with its two renderers, ready to draw the view that openscad would take by default.
class FramePair {
 public:
  FramePair(const csg::Model& model, int threads);
  void drawZbuffer() { zbuffer_.draw(view_); }
  void drawCsg() { csg_.draw(view_); }
  const Stats& stats() const { return csg_.stats(); }

 private:
  csg::Renderer zbuffer_, csg_;
  View view_;
};

csg::RenderOptions renderOptions(const std::string& method, int threads);

FrameMeasurement measureFrames(const std::string& csgFile, const FrameLimits& limits);

// To and from a file: the measurement runs in a process of its own, for a program's peak memory as the system counts it begins with that
// of the one that started it.
std::string toJson(const FrameMeasurement& measurement);
FrameMeasurement frameMeasurementOf(const std::string& json);

}  // namespace copeel::bench
