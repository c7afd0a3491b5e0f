// Meshes of any opacity to an image. Prepare once, then draw as many frames as wanted.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "core/image/image.h"
#include "core/methods/method.h"
#include "core/metrics/stats.h"
#include "core/scene/box.h"
#include "core/scene/mesh.h"
#include "core/scene/view.h"

namespace copeel::oit {

// An object of the picture. Parts are in the order of the command line: of coplanar faces, the later part's lies in front.
struct Part {
  std::shared_ptr<const Mesh> mesh;
  glm::vec4 color{255, 255, 255, 1};       // 0 … 255, and alpha 0 … 1
  std::vector<glm::vec4> faceColors;       // per triangle; empty: all have `color`
  glm::dmat4 worldFromObject{1.0};
};

struct RenderOptions {
  std::array<double, 3> background{255, 255, 229};
  bool lit = true;
  double coplanarTolerance = 0;    // model units; 0: from the scene (see core/coplanarity/plane_classes.h)
  int threads = 0;                 // 0: all cores
  int samples = 1;                 // anti-aliasing samples per pixel
  const MethodInfo* method = findMethod("tile");   // of either back end
  MethodOptions methodOptions;
  bool wantFloats = false, wantDepth = false, wantIds = false, wantLayers = false, wantCoplanar = false;
  bool decideAllExactly = false;   // every order by the exact path; for tests, slow
};

// Colours are the mean of the samples; all else is of the pixel's centre. 16-bit values saturate.
struct Frame {
  Image<Rgb8> color;
  Image<glm::vec3> floats;          // wantFloats: the colour before it is rounded, 0 … 255
  Image<float> depth;               // wantDepth: of the nearest surface that is not wholly transparent, model units, +inf where there is none
  Image<std::uint16_t> ids;         // wantIds: 1 + index of its part, 0 for nothing
  Image<std::uint16_t> layers;      // wantLayers: fragments, also those hidden or of alpha 0
  Image<std::uint16_t> coplanar;    // wantCoplanar: fragments of the largest coplanar group
};

class Renderer {
 public:
  Renderer(std::vector<Part> parts, const RenderOptions& options);
  ~Renderer();

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

}  // namespace copeel::oit
