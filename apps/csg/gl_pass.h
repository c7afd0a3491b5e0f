// One pass of a CSG model through the gl back end: the same surfaces to the same sink as the tile renderer's, by any method of the registry.
#pragma once

#include <memory>

#include "apps/csg/csg_fold.h"
#include "core/metrics/stats.h"
#include "core/methods/method.h"

namespace copeel::csg {

class GlPass {
 public:
  // `backgroundCount`: parts 1 … are what % marks, later ones what # marks. Throws Error{Machine}: no GL. The arguments live longer.
  GlPass(const Scene& scene, const PlaneClasses& planes, const GateForest& forest, std::uint32_t backgroundCount, InsideRule rule,
         const MethodOptions& options);
  ~GlPass();

  // `alpha` and `context` as CsgFold's. Throws Error{Machine}: the fold's state needs more memory than there is.
  void draw(const View& view, const EyeWinding& eye, CsgFold::Alpha alpha, const void* context, const MethodInfo& method,
            PixelSink& sink, Stats& stats);
  void setOptions(const MethodOptions& options);   // the depth source stays
  // Counts what the method delivers of the last view (core/gl/measure.h).
  void measure(const MethodInfo& method, Stats& stats);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace copeel::csg
