// Every shader of every method with every fold is standard GLSL 4.50, not just what one driver takes: the reference compiler compiles it offline.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "core/error.h"
#include "tests/support/gl_stacks.h"
#include "tests/support/meshes.h"
#include "tests/support/views.h"
#include "tests/temporary_folder.h"

namespace copeel::test {
namespace {

// What the reference compiler complains of; empty: nothing.
std::string complaint(const std::string& file, const gl::Defines& defines, const char* stage) {
  const TemporaryFolder folder;
  std::vector<std::string> files;
  const std::string source = folder.file(fmt::format("shader.{}", stage)), log = folder.file("log");
  std::ofstream(source) << gl::shaderSource(file, defines, files);
  const std::string command = fmt::format("glslangValidator -S {} '{}' > '{}' 2>&1", stage, source, log);
  if (std::system(command.c_str()) == 0) return "";
  std::ifstream in(log);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<gl::FoldSource> folds() {
  gl::FoldSource count, record;
  count.defines = {{"FOLD", "core/fold/count.glsl"}};
  count.stateWords = 4;
  count.resultWords = 3;
  record.defines = {{"FOLD", "core/fold/record.glsl"}, {"FOLD_RECORD_CAPACITY", "64"}};
  record.stateWords = 2;
  record.resultWords = 130;
  return {count, record};
}

TEST(GlShaders, areStandard) {
  if (std::system("glslangValidator --version > /dev/null 2>&1") != 0) GTEST_SKIP() << "no glslangValidator (Debian package glslang-tools)";
  const Scene scene({{share(box({0, 0, 0}, {1, 1, 1}))}});
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  renderer.setView(lookAt({3, 2, 4}, {0, 0, 0}, 16, 16, 0.02));
  for (const gl::FoldSource& fold : folds()) {
    renderer.setFold(fold);
    for (const MethodInfo& method : methods()) {
      if (!method.draw) continue;
      renderer.draw(method.draw, {});
      renderer.draw(method.draw, {.cull = true});
      renderer.draw(method.draw, {.occupancy = true});
    }
  }
  std::set<std::string> compiled;
  for (const gl::Programs::Made& made : renderer.programs().all()) {
    const bool compute = made.fragmentPath.empty();
    EXPECT_EQ(complaint(compute ? made.vertexPath : made.fragmentPath, made.defines, compute ? "comp" : "frag"), "") << made.fragmentPath;
    if (compute || !compiled.insert(made.vertexPath).second) continue;
    EXPECT_EQ(complaint(made.vertexPath, made.defines, "vert"), "") << made.vertexPath;
  }
}

TEST(GlShaders, faultsNameFileAndLine) {
  const gl::Context context;
  try {
    gl::Program("core/gl/pixels.vert.glsl", "core/gl/begin.glsl", {{"FOLD", "core/fold/count.glsl"}, {"main", "4"}});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Machine);
    EXPECT_NE(std::string(error.what()).find("core/gl/pixels.vert.glsl:2: "), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace copeel::test
