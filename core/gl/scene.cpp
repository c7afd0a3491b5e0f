#include "core/gl/scene.h"

#include <map>

#include "core/error.h"
#include "core/gl/context.h"
#include "core/gl/layout.h"

namespace copeel::gl {
namespace {

Placement placementOf(const Object& object, std::uint32_t firstVertex, std::uint32_t firstClip) {
  Placement placement{};
  for (int column = 0; column < 4; ++column) {
    for (int row = 0; row < 4; ++row) placement.columns[column][row] = object.worldFromObject[column][row];
  }
  placement.firstVertex = firstVertex;
  placement.vertexCount = static_cast<std::uint32_t>(object.mesh->vertices.size());
  placement.firstClip = firstClip;
  return placement;
}

}  // namespace

SceneBuffers::SceneBuffers(const Scene& scene, const PlaneClasses& planes) : scene_(scene), planes_(planes) {
  // An id's top bit says from which side a fragment was met.
  if (scene.primitiveCount() >= COPEEL_ID_PRIMITIVE) failMachine("gl: more than {} triangles", COPEEL_ID_PRIMITIVE);
  uploadMeshes();
  uploadPrimitives();
  checkErrors("uploading the scene");
}

void SceneBuffers::uploadMeshes() {
  std::vector<glm::dvec3> vertices;
  std::vector<glm::uvec3> indices;
  std::vector<Placement> placements;
  std::vector<Command> commands;
  struct Place {
    std::uint32_t vertex, triangle;
  };
  std::map<const Mesh*, Place> places;
  for (const Object& object : scene_.objects()) {
    const Mesh& mesh = *object.mesh;
    const Place next{static_cast<std::uint32_t>(vertices.size()), static_cast<std::uint32_t>(indices.size())};
    const auto [place, isNew] = places.emplace(&mesh, next);
    if (isNew) {
      vertices.insert(vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
      indices.insert(indices.end(), mesh.triangles.begin(), mesh.triangles.end());
    }
    placements.push_back(placementOf(object, place->second.vertex, clipCount_));
    commands.push_back({static_cast<std::uint32_t>(mesh.triangles.size() * 3), 1, place->second.triangle * 3,
                        static_cast<std::int32_t>(clipCount_), static_cast<std::uint32_t>(commands.size())});
    clipCount_ += placements.back().vertexCount;
  }
  vertices_ = Buffer(vertices);
  indices_ = Buffer(indices);
  placements_ = Buffer(placements);
  commands_ = Buffer(commands);
}

void SceneBuffers::uploadPrimitives() {
  std::vector<Primitive> primitives;
  std::vector<std::uint32_t> firstPrimitives;
  primitives.reserve(scene_.primitiveCount());
  for (std::uint32_t object = 0; object < scene_.objects().size(); ++object) {
    const Mesh& mesh = *scene_.objects()[object].mesh;
    firstPrimitives.push_back(static_cast<std::uint32_t>(primitives.size()));
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) primitives.push_back({planes_.classOf(object, mesh.facetOf(t)), object});
  }
  primitives_ = Buffer(primitives);
  firstPrimitives_ = Buffer(firstPrimitives);

  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  array_ = VertexArray(name);
  glVertexArrayElementBuffer(name, indices_.name());
  glEnableVertexArrayAttrib(name, COPEEL_ATTRIBUTE_CLIP);
  glVertexArrayAttribFormat(name, COPEEL_ATTRIBUTE_CLIP, 4, GL_FLOAT, GL_FALSE, 0);
  glVertexArrayAttribBinding(name, COPEEL_ATTRIBUTE_CLIP, COPEEL_ATTRIBUTE_CLIP);
  glEnableVertexArrayAttrib(name, COPEEL_ATTRIBUTE_FIRST_PRIMITIVE);
  glVertexArrayAttribIFormat(name, COPEEL_ATTRIBUTE_FIRST_PRIMITIVE, 1, GL_UNSIGNED_INT, 0);
  glVertexArrayAttribBinding(name, COPEEL_ATTRIBUTE_FIRST_PRIMITIVE, COPEEL_ATTRIBUTE_FIRST_PRIMITIVE);
  glVertexArrayBindingDivisor(name, COPEEL_ATTRIBUTE_FIRST_PRIMITIVE, 1);
  glVertexArrayVertexBuffer(name, COPEEL_ATTRIBUTE_FIRST_PRIMITIVE, firstPrimitives_.name(), 0, sizeof(std::uint32_t));
}

void SceneBuffers::draw(const Buffer& clip, std::uint32_t begin, std::uint32_t end) const {
  glBindVertexArray(array_);
  glVertexArrayVertexBuffer(array_, COPEEL_ATTRIBUTE_CLIP, clip.name(), 0, 4 * sizeof(float));
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands_.name());
  glMultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, reinterpret_cast<const void*>(begin * sizeof(Command)),
                              static_cast<GLsizei>(end - begin), 0);
}

}  // namespace copeel::gl
