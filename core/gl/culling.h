// Geometry culling of objects that are wholly peeled: an occlusion query of each object's bounding box against what pixels have left, and
// conditional rendering of the object on its result. What was passed over once is passed over for the rest of the frame.
//
// Based on: Vasilakis, Fudos. Depth-Fighting Aware Methods for Multifragment Rendering. IEEE TVCG 19(6), 2013, section 3.3.
// Changed: the box is one of the window, whole pixels by a range of depth keys, and holds every fragment of the object for certain: its keys come from the
// planes of the object's faces over those pixels. (A box of the scene is rasterized by itself, and might miss a pixel or a depth.)
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/gl/depth_keys.h"
#include "core/gl/objects.h"
#include "core/gl/program.h"
#include "core/image/image.h"

namespace copeel::gl {

struct ObjectBox {
  PixelRect pixels{};
  std::uint32_t leastKey = 0, greatestKey = 0;
};

// The pixels whose centres a box may cover: all of them where a corner is nearer than `nearest`.
PixelRect windowBox(const Box& box, const glm::dmat4& worldFromObject, const View& view, double nearest);

std::vector<ObjectBox> objectBoxes(const Scene& scene, const PlaneClasses& planes, const View& view, const DepthPlanes& depths,
                                   bool hardwareDepth);

class Culling {
 public:
  explicit Culling(std::vector<ObjectBox> boxes);

  void restart();   // all objects are to be drawn
  // Asks for each object that is still drawn whether `box` passes any sample of its box; drawBox draws its pixels.
  void ask(const Program& box, const std::function<void(const PixelRect&)>& drawBox);
  // Draws of the objects [begin, end) those that have something left, and returns their number.
  std::uint32_t draw(std::uint32_t begin, std::uint32_t end, const std::function<void(std::uint32_t, std::uint32_t)>& drawRun);

 private:
  void settle();

  std::vector<ObjectBox> boxes_;
  std::vector<Query> queries_;
  std::vector<bool> drawn_;
  bool asked_ = false;   // and not answered yet
};

}  // namespace copeel::gl
