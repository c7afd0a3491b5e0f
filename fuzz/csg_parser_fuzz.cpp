// Any bytes are a model or an Error of one line: never a crash, a hang or a memory of their choosing. openscad is never run.
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "apps/csg/read_model.h"
#include "core/error.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string text(reinterpret_cast<const char*>(data), size);
  copeel::csg::ReadOptions options;
  options.openscad = "/nonexistent/openscad";
  try {
    const copeel::csg::Model model = copeel::csg::parseCsg(text, "fuzz.csg", "/nonexistent", options);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const copeel::csg::Node& node = model.nodes[i];
      for (std::uint32_t c = 0; c < node.childCount; ++c) {
        if (model.childIndices.at(node.firstChild + c) >= i) std::abort();
      }
    }
    for (const copeel::csg::Leaf& leaf : model.leaves) {
      for (const glm::uvec3& t : leaf.mesh->triangles) {
        if (t.x >= leaf.mesh->vertices.size() || t.y >= leaf.mesh->vertices.size() || t.z >= leaf.mesh->vertices.size()) std::abort();
      }
    }
  } catch (const copeel::Error& error) {
    if (std::string(error.what()).find('\n') != std::string::npos) std::abort();
  }
  return 0;
}
