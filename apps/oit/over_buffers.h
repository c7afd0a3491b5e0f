// The tables of transparency on the device, and the fold that reads them: core/gl/fold_over.glsl.
#pragma once

#include "core/fold/over.h"
#include "core/gl/frame.h"
#include "core/scene/scene.h"

namespace copeel::oit {

// Words of a pixel's result: colour (three doubles, premultiplied), transmittance (a double), id + 1 of the nearest primitive that is seen, fragments,
// fragments of the largest group, and one that is 0: whole texels, which llvmpipe writes in the time of half as many words.
inline constexpr std::uint32_t kOverResultWords = 12;

class OverBuffers {
 public:
  // `tables`: with the shades of the view. `mayEnd`: a pixel has enough at an opaque fragment. The fold reads from this object, which lives longer.
  gl::FoldSource upload(const Scene& scene, const fold::OverTables& tables, bool mayEnd);

 private:
  gl::Buffer bases_, ranges_, shades_;
};

}  // namespace copeel::oit
