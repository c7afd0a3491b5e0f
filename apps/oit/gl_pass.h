// One pass of transparency through the gl back end: the same targets as the tile renderer's, by any method of the registry.
#pragma once

#include <memory>

#include "apps/oit/over_fold.h"
#include "core/metrics/stats.h"
#include "core/methods/method.h"

namespace copeel::oit {

class GlPass {
 public:
  // Throws Error{Machine}: no GL. The arguments live longer.
  // `opaque`: per object, whether all of its faces are.
  GlPass(const Scene& scene, const PlaneClasses& planes, const std::vector<std::uint8_t>& opaque, const MethodOptions& options);
  ~GlPass();

  // `tables`: with the shades of the view. `mayEnd`: a pixel has enough at an opaque fragment; opaque objects are drawn first, and hide what is behind.
  void draw(const View& view, const fold::OverTables& tables, const glm::vec3& background, bool mayEnd, const MethodInfo& method,
            const Targets& targets, Stats& stats);
  void setOptions(const MethodOptions& options);   // of the frames to come; the source of depth stays
  // Counts what the method delivers of the last view (core/gl/measure.h).
  void measure(const MethodInfo& method, Stats& stats);

 private:
  void deliver(const View& view, const glm::vec3& background, const Targets& targets) const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace copeel::oit
