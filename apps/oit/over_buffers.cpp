#include "apps/oit/over_buffers.h"

namespace copeel::oit {
namespace {

constexpr std::uint32_t kStateWords = 24;   // of core/gl/fold_over.glsl

}  // namespace

gl::FoldSource OverBuffers::upload(const Scene& scene, const fold::OverTables& tables, bool mayEnd) {
  // Shaders know a primitive, not which of its object it is: the object's first is taken off here, modulo 2^32.
  std::vector<fold::BaseRange> shifted = tables.ranges;
  for (std::uint32_t object = 0; object < shifted.size(); ++object) shifted[object].first -= shifted[object].stride * scene.firstPrimitive(object);
  bases_ = gl::Buffer(tables.bases);
  ranges_ = gl::Buffer(shifted);
  shades_ = gl::Buffer(tables.shades);
  gl::FoldSource fold;
  fold.defines = {{"FOLD", "core/gl/fold_over.glsl"}, {"FOLD_MAY_END", mayEnd ? "1" : "0"}, {"FOLD_WORDS", "uvec4"}};
  fold.stateWords = kStateWords;
  fold.resultWords = kOverResultWords;
  fold.tables = {{&bases_, GL_RGBA32F}, {&ranges_, GL_RG32UI}, {&shades_, GL_R32F}};
  return fold;
}

}  // namespace copeel::oit
