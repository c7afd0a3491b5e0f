// How a method of the gl back end is called. Each is one function in one .cpp with one .glsl of the same stem, and one line in registry.cpp.
#pragma once

#include <cstdint>
#include <string>

namespace copeel::gl {
class Frame;
}

namespace copeel {

struct MethodOptions {
  std::uint32_t k = 8;                       // buffer length where the method has one: fragments
  std::uint64_t memoryBytes = 0;             // the method's buffers together; 0: no limit
  bool hardwareDepth = false;                // --depth-source hardware: the rasterizer's depth, as in the papers
  bool cull = false;                         // +cull: pass over objects that are wholly peeled (2013, section 3.3)
  bool occupancy = false;                    // +occupancy: occupancy maps (2015)
  bool allOrNothing = false;                 // a method of growing memory that is too short delivers nothing
  std::uint32_t occupancyWords = 4;          // d of 2015, 1 ... 64: 32 d intervals of depth
};

// What a run of a method says of itself. Passes and bytes the frame counts.
struct MethodCounts {
  std::uint64_t iterations = 0;              // peeling iterations, 1 for single-pass methods
  std::uint64_t overflow = 0;                // fragments that a full buffer could not take
  std::uint64_t repeats = 0;                 // passes done again with larger buffers, or because of hazards
  std::uint64_t hazards = 0;                 // read-modify-write hazards that were met
  std::string chosen = {}, reason = {};          // auto: the method, and why
};

// The frame has a view and a fold, and begin() was called. The method delivers to the fold's states; foldFinish comes after it.
using DrawMethod = MethodCounts (*)(gl::Frame& frame, const MethodOptions& options);

}  // namespace copeel
