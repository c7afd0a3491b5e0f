#include "apps/oit/read_parts.h"

#include <algorithm>
#include <map>

#include "core/formats/read_mesh.h"

namespace copeel::oit {
namespace {

// For parts without a colour, one after the other; tells them apart also for eyes that confuse red and green.
// Based on: Okabe, Ito. Color Universal Design. 2008.
constexpr std::array<std::array<float, 3>, 7> kPalette = {
    {{230, 159, 0}, {86, 180, 233}, {0, 158, 115}, {240, 228, 66}, {0, 114, 178}, {213, 94, 0}, {204, 121, 167}}};

glm::vec3 toVector(const std::array<double, 3>& c) { return {c[0], c[1], c[2]}; }

Part partOf(std::size_t index, const MeshArgument& file, const CommonLook& look, const std::shared_ptr<const Mesh>& mesh) {
  const auto color = file.color ? file.color : look.color;
  const auto alpha = file.alpha ? file.alpha : look.alpha;
  const std::array<float, 3>& other = kPalette[index % kPalette.size()];
  const glm::vec3 rgb = color ? toVector(*color) : glm::vec3(other[0], other[1], other[2]);
  Part part{mesh, glm::vec4(rgb, alpha ? static_cast<float>(*alpha) : kDefaultAlpha), {}};
  if (mesh->colors.empty() || (color && alpha)) return part;

  // What the command line left open is the file's to say, face by face.
  part.faceColors = mesh->colors;
  for (glm::vec4& face : part.faceColors) {
    if (color || face.r == Mesh::kNotGiven) face = glm::vec4(glm::vec3(part.color), face.a);
    if (alpha || face.a == Mesh::kNotGiven) face.a = part.color.a;
  }
  return part;
}

}  // namespace

std::vector<Part> readParts(const std::vector<MeshArgument>& files, const CommonLook& look, std::vector<std::string>& warnings) {
  std::map<std::string, std::shared_ptr<const Mesh>> meshes;
  std::vector<Part> parts;
  for (const MeshArgument& file : files) {
    std::shared_ptr<const Mesh>& mesh = meshes[file.path];
    if (!mesh) mesh = std::make_shared<const Mesh>(readMesh(file.path, {.colors = true, .warnings = &warnings}));
    parts.push_back(partOf(parts.size(), file, look, mesh));
  }
  return parts;
}

}  // namespace copeel::oit
