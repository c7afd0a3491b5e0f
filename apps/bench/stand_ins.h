// The scenes of the 2013 paper's figures and of the speed part: meshes from a folder with models/*.ply where one is given, generated bodies otherwise.
// Files are read when asked for; throws Error{Input} as readMesh does where one is missing.
#pragma once

#include <string>

#include "apps/bench/scenes.h"

namespace copeel::bench {

class StandIns {
 public:
  explicit StandIns(std::string folder) : folder_(std::move(folder)) {}

  bool areFiles() const { return !folder_.empty(); }
  BenchScene crank() const;                              // fig. 7: nothing coplanar
  BenchScene fandisk(std::size_t copyCount) const;       // fig. 8: coincident copies
  std::vector<BenchScene> deep() const;                  // fig. 9: from few fragments to many
  BenchScene dragons() const;                            // fig. 10: three in a row along the view
  BenchScene bunny(std::size_t copyCount) const;         // of about 69,000 triangles
  BenchScene peer() const;                               // small enough for VTK: a shell, or the bunny
  BenchScene hairball() const;                           // of a million triangles

 private:
  Mesh read(const char* name) const;

  std::string folder_;
};

}  // namespace copeel::bench
