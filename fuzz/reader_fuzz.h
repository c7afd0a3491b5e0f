// What every mesh fuzzer does: read the bytes, and of what is read, check that it can be used. Only Error{Input} may be thrown.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/formats/read_mesh.h"
#include "core/formats/readers.h"

namespace copeel {

inline int fuzzReader(Mesh (*read)(const Source&, const ReadMeshOptions&), const std::uint8_t* data, std::size_t size) {
  try {
    const Mesh mesh = read(Source({reinterpret_cast<const char*>(data), size}, "fuzz"), {.colors = true});
    for (const glm::uvec3& t : mesh.triangles) {
      for (int i = 0; i < 3; ++i) COPEEL_CHECK(t[i] < mesh.vertices.size(), "index {}", t[i]);
    }
    COPEEL_CHECK(mesh.facets.empty() || mesh.facets.size() == mesh.triangles.size());
    COPEEL_CHECK(mesh.colors.empty() || mesh.colors.size() == mesh.triangles.size());
    statusOf(mesh);
  } catch (const Error& error) {
    COPEEL_CHECK(error.code() == ExitCode::Input, "{}", error.what());
    COPEEL_CHECK(std::string(error.what()).find('\n') == std::string::npos, "{}", error.what());
  }
  return 0;
}

}  // namespace copeel
