// The .glsl files that the library carries; written by cmake/embed_shaders.cmake.
#pragma once

#include <span>
#include <string_view>

namespace copeel::gl {

struct EmbeddedShader {
  std::string_view path;   // from the source's root
  std::string_view text;
};

std::span<const EmbeddedShader> embeddedShaders();

}  // namespace copeel::gl
