// A scene on the device: vertices in double, as files and transforms left them, and what a fragment has to know of its primitive.
// Meshes that several objects use are held once; their projected vertices are held per object (16 bytes each).
#pragma once

#include <cstdint>
#include <vector>

#include "core/coplanarity/plane_classes.h"
#include "core/gl/objects.h"
#include "core/scene/view.h"

namespace copeel::gl {

struct Primitive {
  std::uint32_t planeClass;
  std::uint32_t object;
};
static_assert(sizeof(Primitive) == 8);

// How an object's vertices are found, for the projection: std430.
struct Placement {
  double columns[4][4];            // worldFromObject, each column padded to dvec4
  std::uint32_t firstVertex;       // of its mesh, in the vertices of all meshes
  std::uint32_t vertexCount;
  std::uint32_t firstClip;         // where its projected vertices go
  std::uint32_t padding[5];
};
static_assert(sizeof(Placement) == 160);

class SceneBuffers {
 public:
  SceneBuffers(const Scene& scene, const PlaneClasses& planes);

  const Scene& scene() const { return scene_; }
  const PlaneClasses& planes() const { return planes_; }
  const Buffer& vertices() const { return vertices_; }       // double x, y, z
  const Buffer& placements() const { return placements_; }   // Placement per object
  const Buffer& primitives() const { return primitives_; }   // Primitive per primitive
  std::uint32_t clipCount() const { return clipCount_; }     // projected vertices

  // Draws the objects [begin, end), one command each; the program and its targets are bound. `clip` holds the projected vertices.
  void draw(const Buffer& clip, std::uint32_t begin, std::uint32_t end) const;

 private:
  struct Command {                 // glMultiDrawElementsIndirect's record
    std::uint32_t count, instanceCount, firstIndex;
    std::int32_t baseVertex;
    std::uint32_t baseInstance;
  };
  void uploadMeshes();
  void uploadPrimitives();

  const Scene& scene_;
  const PlaneClasses& planes_;
  Buffer vertices_, indices_, placements_, primitives_, firstPrimitives_, commands_;
  VertexArray array_;
  std::uint32_t clipCount_ = 0;
};

}  // namespace copeel::gl
