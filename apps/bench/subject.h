// A scene at one size, ready to be drawn by any method: its renderer, and what is right.
#pragma once

#include "apps/bench/measure.h"

namespace copeel::bench {

class Subject {
 public:
  // `compares`: with the reference; else frames are only timed. One source of depth: the device has room for one context.
  Subject(const BenchScene& scene, int width, int height, const MeasureOptions& options, bool hardwareDepth, bool compares);

  const Shape& shape() const { return shape_; }
  double warm(const MethodRun& run, Entry& entry);   // the first frames: error, counts, pictures; ms of the least
  double time(const MethodRun& run, Entry& entry);   // another one: its ms

 private:
  double draw(oit::Frame& frame);
  void count(const MethodRun& run, Entry& entry);
  void writePictures(Entry& entry, const oit::Frame& frame) const;

  const MeasureOptions& options_;
  bool compares_;
  oit::Renderer renderer_;
  View view_;
  Shape shape_;
  oit::Frame reference_;
  Stats truth_;
  std::vector<std::uint8_t> onEdge_;
};

}  // namespace copeel::bench
