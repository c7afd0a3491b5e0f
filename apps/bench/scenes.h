// The scenes of the bench, made by formula (no files needed, the same on every machine), or a mesh from a file.
#pragma once

#include <string>
#include <vector>

#include "apps/bench/bodies.h"
#include "apps/oit/render_oit.h"
#include "core/scene/camera.h"

namespace copeel::bench {

struct BenchScene {
  std::string name;
  std::string title;
  std::vector<oit::Part> parts;
  CameraOptions camera = {};   // without numbers: openscad's angle, from afar enough to show all of it
};

BenchScene copies(const Mesh& mesh, std::size_t count, std::string name);
BenchScene threeInARow(const Mesh& mesh);               // along the line of sight
// Rectangles across the left half of the picture: each of its pixels has `depths` depths of `coplanar` fragments.
BenchScene stack(unsigned depths, unsigned coplanar);

// Names of the generated scenes, in the report's order.
const std::vector<std::string>& sceneNames();
// One of those names, or a mesh file. Throws Error{Input} as readMesh does.
BenchScene sceneOf(const std::string& name, std::size_t copyCount);
bool isCoplanar(const std::string& sceneName, std::size_t copyCount);   // has coplanar fragments by its making

View viewOf(const BenchScene& scene, const Box& bounds, int width, int height);

}  // namespace copeel::bench
