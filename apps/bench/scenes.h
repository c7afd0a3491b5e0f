// The scenes of the bench, made by formula (no files needed, the same on every machine), or a mesh from a file.
#pragma once

#include <string>
#include <vector>

#include "apps/oit/render_oit.h"

namespace copeel::bench {

struct BenchScene {
  std::string name;
  std::string title;
  std::vector<oit::Part> parts;
  bool alongAxis = false;   // seen along -x, not obliquely
};

// Bodies of the sweeps.
Mesh bumpySphere(unsigned columns, unsigned rows);      // closed, radius about 1
Mesh shells(unsigned count, unsigned columns, unsigned rows);   // closed convex shells in one another: exactly 2 · count layers in the middle
BenchScene copies(const Mesh& mesh, std::size_t count, std::string name);
BenchScene threeInARow();                               // along the line of sight

// Names of the generated scenes, in the report's order.
const std::vector<std::string>& sceneNames();
// One of those names, or a mesh file. Throws Error{Input} as readMesh does.
BenchScene sceneOf(const std::string& name, std::size_t copyCount);

// From afar enough to show all of it.
View viewOf(const BenchScene& scene, const Box& bounds, int width, int height);

}  // namespace copeel::bench
