// One view of a scene made ready for tiles: projected, binned, with a depth function per plane class.
#pragma once

#include <vector>

#include "core/coplanarity/depth_planes.h"
#include "core/cpu/binning.h"

namespace copeel::cpu {

struct Frame {
  Frame(const Scene& scene, const PlaneClasses& planes, const View& view);

  const Scene& scene;
  const PlaneClasses& planes;
  const View& view;
  Projection projection;
  Bins bins;
  DepthPlanes depths;   // made last: tiles, which come next, read it far and wide

  int tileCount() const { return bins.columns * bins.rows; }
};

}  // namespace copeel::cpu
