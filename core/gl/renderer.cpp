#include "core/gl/renderer.h"

#include <algorithm>

namespace copeel::gl {
namespace {

constexpr std::uint64_t kCounterBytes = 4096;   // what methods may take in buffers of a few words, which their own sums leave out

}  // namespace

Renderer::Renderer(const Scene& scene, const PlaneClasses& planes, DepthSource depthSource)
    : scene_(scene), planes_(planes), buffers_(scene, planes), frame_(buffers_, programs_, depthSource) {}

void Renderer::setView(const View& view) {
  context_.makeCurrent();
  frame_.setView(view, depthPlanes(scene_, planes_, view));
}

void Renderer::setFold(const FoldSource& fold) {
  context_.makeCurrent();
  frame_.setFold(fold);
}

std::vector<std::uint32_t> Renderer::result() const {
  context_.makeCurrent();
  return frame_.result();
}

void Renderer::visitResult(const std::function<void(int, std::span<const std::uint32_t>)>& visitor) const {
  context_.makeCurrent();
  frame_.visitResult([&](int firstRow, std::span<const std::uint32_t> words) {
    visitor(firstRow, words);
    context_.makeCurrent();   // a visitor that waits for threads may have been lent to another renderer
  });
}

FrameCounts Renderer::draw(DrawMethod method, const MethodOptions& options, const std::function<void(Frame&)>& before) {
  context_.makeCurrent();
  frame_.begin();
  if (before) before(frame_);
  FrameCounts counts;
  MethodOptions own = options;
  // The scene and the fold have had their share of --memory; what the method holds from an earlier frame is its own.
  if (options.memoryBytes > 0 && DeviceMemory::left() < options.memoryBytes) {
    const std::uint64_t left = DeviceMemory::left() + frame_.heldBytes();
    own.memoryBytes = std::clamp<std::uint64_t>(left - std::min(left, kCounterBytes), 1, options.memoryBytes);
  }
  counts.method = method(frame_, own);
  frame_.finish();
  counts.passes = frame_.passes();
  counts.objectsDrawn = frame_.objectsDrawn();
  counts.passMs = frame_.passMs();
  counts.methodBytes = frame_.methodBytes();
  counts.foldBytes = frame_.foldBytes();
  return counts;
}

}  // namespace copeel::gl
