# Writes OUTPUT, a C++ file that holds the text of each of FILES (paths from ROOT, separated by commas): cmake -D... -P.
string(REPLACE "," ";" FILES "${FILES}")
set(entries "")
foreach(path ${FILES})
  file(READ "${ROOT}/${path}" text)
  string(APPEND entries "    {\"${path}\", R\"glsl(${text})glsl\"},\n")
endforeach()
file(WRITE "${OUTPUT}" "// Written by cmake/embed_shaders.cmake.
#include \"core/gl/embedded_shaders.h\"

namespace copeel::gl {

std::span<const EmbeddedShader> embeddedShaders() {
  static constexpr EmbeddedShader all[] = {
${entries}  };
  return all;
}

}  // namespace copeel::gl
")
