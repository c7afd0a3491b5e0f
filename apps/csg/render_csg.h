// A CSG model to an image.
//
// Prepare once (plane classes, winding at the eye is per view), then draw as many frames as wanted.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/csg/csg_model.h"
#include "core/image/image.h"
#include "core/methods/method.h"
#include "core/metrics/stats.h"
#include "core/scene/box.h"
#include "core/scene/view.h"

namespace copeel::csg {

enum class InsideRule : std::uint8_t { NonZero, Positive, Odd };

// Colours 0 … 255 as openscad names them.
struct ColorScheme {
  std::array<double, 3> background{255, 255, 229};
  std::array<double, 3> front{249, 215, 44};     // faces of the part
  std::array<double, 3> cutout{157, 203, 81};    // faces left by a subtracted solid
};

struct Section {
  int axis = 0;          // 0 x, 1 y, 2 z
  double at = 0;         // model units; the half-space beyond it (coordinate > at) is cut away …
  bool below = false;    // … or the one before it (coordinate < at)
};

struct RenderOptions {
  InsideRule inside = InsideRule::NonZero;
  ColorScheme scheme;
  bool lit = true;
  bool edges = false;              // a black line of one pixel where one visible face ends and another begins
  std::vector<Section> sections;
  double coplanarTolerance = 0;    // model units; 0: from the scene (see core/coplanarity/plane_classes.h)
  int threads = 0;                 // 0: all cores
  int samples = 1;                 // anti-aliasing samples per pixel
  const MethodInfo* method = findMethod("tile");   // of either back end
  MethodOptions methodOptions;
  bool wantDepth = false;
  bool wantIds = false;
  bool decideAllExactly = false;   // every order by the exact path; for tests, slow
};

struct Frame {
  Image<Rgb8> color;
  Image<float> depth;              // wantDepth: distance along the view axis, model units, +inf where nothing is seen
  Image<std::uint16_t> ids;        // wantIds: 1 + index of the visible leaf, 0 for nothing; saturates at 65535
};

class Renderer {
 public:
  Renderer(const Model& model, const RenderOptions& options);
  ~Renderer();

  // Bounds of all leaves of the solid, for --viewall: what openscad takes.
  const Box& bounds() const;
  // Of the frames to come: scene, planes and what is on the device stay.
  void setMethod(const MethodInfo& method, const MethodOptions& options);
  Frame draw(const View& view);
  const Stats& stats() const;      // of preparation and the last frame
  void measure();                  // counts the last frame's fragments, where drawing it did not (the gl back end)

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace copeel::csg
