// How many pixels of a picture a mesh covers: the whole way from a file to the nearest fragment of each pixel.
#include <atomic>
#include <cstdio>

#include <core/cpu/render_nearest.h>
#include <core/formats/read_mesh.h>
#include <core/scene/camera.h>

int main(int, char** argv) {
  const copeel::Scene scene({{std::make_shared<copeel::Mesh>(copeel::readMesh(argv[1]))}});
  const copeel::PlaneClasses planes(scene, 0);
  const copeel::View view = copeel::viewOf({}, scene.bounds());
  std::atomic<int> covered = 0;
  copeel::cpu::renderNearest(copeel::cpu::Frame(scene, planes, view), [&](int, int, const auto&, const auto&) { ++covered; });
  std::printf("%d pixels\n", covered.load());
}
