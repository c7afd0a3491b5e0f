#include "core/methods/layers.h"

#include <algorithm>

namespace copeel {
namespace {

const std::string kFindFile = "core/gl/find_layer.glsl";

}  // namespace

Layers::Layers(gl::Frame& frame, Ends ends, const MethodOptions& options) : frame_(frame), ends_(ends), cull_(options.cull) {
  frame.pixelWords(ends == Ends::Front ? "layers" : "layerRanges", 0, ends == Ends::Front ? 1 : 4);
  frame.writeTargets(0);
  frame.noDepthTest();
  frame.beginStates();
  frame.drawPixels(resolveProgram(kFindFile, "BEGIN"));
}

bool Layers::next() { return next(gatherProgram(kFindFile, "FIND")); }

bool Layers::next(const gl::Program& find) {
  if (cull_) frame_.cullObjects(resolveProgram(kFindFile, "BOX"));
  if (ends_ == Ends::Front) {
    frame_.clearDepth();
    frame_.testDepth(GL_LESS, true);
  }
  const bool any = frame_.anySamplesOf([&] { frame_.drawGeometry(find); });
  frame_.noDepthTest();
  return any;
}

const gl::Program& Layers::gatherProgram(const std::string& file, const std::string& pass, gl::Defines defines) const {
  if (ends_ == Ends::Both) defines.emplace_back("DUAL", "1");
  return frame_.geometryProgram(file, pass, defines);
}

const gl::Program& Layers::resolveProgram(const std::string& file, const std::string& pass, gl::Defines defines) const {
  if (ends_ == Ends::Both) defines.emplace_back("DUAL", "1");
  return frame_.pixelProgram(file, pass, defines);
}

std::uint32_t Layers::fittingLength(const MethodOptions& options, std::size_t otherWords) const {
  const std::uint32_t most = std::max<std::uint32_t>(options.k, 1);
  if (options.memoryBytes == 0) return most;
  const std::size_t layerWords = ends_ == Ends::Front ? 2 : 4;
  // One word of it counts the overflow.
  const std::size_t words = (std::max<std::size_t>(options.memoryBytes, 4) - 4) / (sizeof(std::uint32_t) * frame_.pixelCount());
  const std::size_t spare = words > layerWords ? (words - layerWords) / sides() : 0;
  return static_cast<std::uint32_t>(std::clamp<std::size_t>(spare > otherWords ? spare - otherWords : 0, 1, most));
}

}  // namespace copeel
