// The gl back end in one object: a context, a scene on the device, and frames of any method with any fold.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/gl/context.h"
#include "core/gl/frame.h"
#include "core/methods/method.h"

namespace copeel::gl {

// What a frame cost.
struct FrameCounts {
  MethodCounts method;
  std::uint64_t passes = 0;         // over the geometry
  std::vector<std::uint32_t> objectsDrawn;   // in each pass
  std::vector<double> passMs;                // from each pass to the next
  std::uint64_t methodBytes = 0;    // of the method's buffers on the device
  std::uint64_t foldBytes = 0;      // of the fold's states and results
};

class Renderer {
 public:
  // Throws Error{Machine}: no GL, no memory.
  Renderer(const Scene& scene, const PlaneClasses& planes, DepthSource depthSource = DepthSource::Planes);

  ~Renderer() { context_.tryMakeCurrent(); }   // its members are the context's
  Renderer(const Renderer&) = delete;

  // Each call makes the context current: renderers may take turns on a thread. Whoever keeps buffers beside one calls this before they go.
  const Context& context() const { return context_; }
  const PlaneClasses& planes() const { return planes_; }
  void setView(const View& view);                  // `view` may go afterwards
  void setFold(const FoldSource& fold);            // after setView; its tables must live on
  // Draws and waits until the device is done. `before`: passes that the fold needs before the method's.
  FrameCounts draw(DrawMethod method, const MethodOptions& options, const std::function<void(Frame&)>& before = {});
  std::vector<std::uint32_t> result() const;       // of the fold
  void visitResult(const std::function<void(int firstRow, std::span<const std::uint32_t> words)>& visitor) const;   // Frame::visitResult
  Frame& frame() { return frame_; }
  const Programs& programs() const { return programs_; }

 private:
  const Scene& scene_;
  const PlaneClasses& planes_;
  Context context_;
  Programs programs_;
  SceneBuffers buffers_;
  Frame frame_;
};

}  // namespace copeel::gl
