#include "core/gl/renderer.h"

namespace copeel::gl {

Renderer::Renderer(const Scene& scene, const PlaneClasses& planes, DepthSource depthSource)
    : scene_(scene), planes_(planes), buffers_(scene, planes), frame_(buffers_, programs_, depthSource) {}

void Renderer::setView(const View& view) { frame_.setView(view, depthPlanes(scene_, planes_, view)); }

FrameCounts Renderer::draw(DrawMethod method, const MethodOptions& options, const std::function<void(Frame&)>& before) {
  frame_.begin();
  if (before) before(frame_);
  FrameCounts counts;
  counts.method = method(frame_, options);
  frame_.finish();
  counts.passes = frame_.passes();
  counts.objectsDrawn = frame_.objectsDrawn();
  counts.passMs = frame_.passMs();
  counts.methodBytes = frame_.methodBytes();
  counts.foldBytes = frame_.foldBytes();
  return counts;
}

}  // namespace copeel::gl
