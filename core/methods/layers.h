// Peeling layer by layer: what the methods share that find the next depth of each pixel in one pass over the geometry and gather its
// fragments in others. From the front, or from both ends at once (dual).
//
// Based on: Everitt. Interactive Order-Independent Transparency. 2001. Bavoil, Myers. Order Independent Transparency with Dual Depth Peeling. 2008.
// Changed: nearest and farthest of a dual layer are integer minima and maxima in a buffer, where the papers blend floats (on llvmpipe 7 % less
// for that pass, for 8 bytes a pixel more); a layer met from both ends is delivered by the front. Bytes per pixel: from the front 8 (least key left, depth buffer), dual 16.
#pragma once

#include "core/gl/frame.h"
#include "core/methods/draw.h"

namespace copeel {

enum class Ends { Front, Both };

class Layers {
 public:
  // Takes buffer slot 0.
  Layers(gl::Frame& frame, Ends ends, const MethodOptions& options);

  // Finds each pixel's next layers, one pass; false when nothing is left anywhere. Leaves the depth test off.
  bool next();
  bool next(const gl::Program& find);   // likewise, by a pass that gathers too

  const gl::Program& gatherProgram(const std::string& file, const std::string& pass, gl::Defines defines = {}) const;
  const gl::Program& resolveProgram(const std::string& file, const std::string& pass, gl::Defines defines = {}) const;
  std::uint32_t sides() const { return ends_ == Ends::Front ? 1 : 2; }

  // The longest arrays, at most options.k and at least 1 per side, that --memory leaves room for beside `otherWords` words a pixel and side.
  std::uint32_t fittingLength(const MethodOptions& options, std::size_t otherWords) const;

 private:
  gl::Frame& frame_;
  Ends ends_;
  bool cull_;
};

}  // namespace copeel
