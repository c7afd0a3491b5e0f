// What a run says of itself: --stats writes these names, scripts depend on them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace copeel {

struct Stats {
  std::string method;
  std::string methodReason;                 // why auto chose it
  std::string backend = "cpu";
  int width = 0;                            // pixels
  int height = 0;
  std::uint64_t triangles = 0;
  std::uint64_t leaves = 0;
  std::uint64_t planeClasses = 0;
  std::uint64_t fragments = 0;              // of the scene in this view, so far as they had to be met
  std::uint64_t fragmentsCaptured = 0;
  std::uint64_t capturedMax = 0;            // of the pixel that has most of them
  std::uint64_t depthComplexityMax = 0;     // fragments of the fullest pixel
  std::uint64_t coveredPixels = 0;
  std::uint64_t coplanarPixels = 0;         // covered pixels with at least one coplanar group of two or more
  std::uint64_t overflow = 0;               // fragments that a full buffer could not take
  std::uint64_t decidedExactly = 0;         // depth orders that the filter left open
  std::uint64_t uncertain = 0;              // depth orders that keys of 30 bits leave open (gl; the cpu decides all)
  std::uint64_t passes = 0;                 // over the scene's geometry
  std::uint64_t iterations = 0;             // of a peeling method, 1 of the others (gl)
  std::uint64_t memoryBytes = 0;            // peak resident set
  std::uint64_t methodBytes = 0;            // of the method's buffers on the device (gl)
  std::vector<std::uint32_t> objectsDrawn;  // in each pass (gl)
  std::vector<double> passMs;               // from each pass to the next (gl)
  double loadMs = 0, prepareMs = 0, frameMedianMs = 0, frameMinMs = 0, totalMs = 0;

  double rh() const { return fragments ? double(fragmentsCaptured) / double(fragments) : 1.0; }
  double cp() const { return coveredPixels ? double(coplanarPixels) / double(coveredPixels) : 0.0; }
};

std::string toJson(const Stats& stats);

// The peak resident set of this process.
std::uint64_t peakMemoryBytes();

}  // namespace copeel
