// Every shader of every method with every fold is standard GLSL 4.50, not just what one driver takes: the reference compiler compiles it offline.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <set>

#include "core/error.h"
#include "core/gl/embedded_shaders.h"
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

// One past what closes the bracket that opens at `at`.
std::size_t closing(std::string_view text, std::size_t at) {
  const char opens = text[at], closes = opens == '(' ? ')' : '}';
  for (int depth = 0; at < text.size(); ++at) {
    depth += text[at] == opens ? 1 : text[at] == closes ? -1 : 0;
    if (depth == 0) return at + 1;
  }
  return text.size();
}

// The block or the statement that begins at `begin`.
std::string_view statementAt(std::string_view text, std::size_t begin) {
  const std::size_t first = std::min(text.find_first_of("{;", begin), text.size());
  return text.substr(begin, (first < text.size() && text[first] == '{' ? closing(text, first) : first) - begin);
}

// The bodies of functions with parameters that go out.
std::vector<std::string_view> bodiesWithOutParameters(std::string_view text) {
  std::vector<std::string_view> bodies;
  for (const char* word : {"(out ", ", out ", "(inout ", ", inout ", "INOUT("}) {
    for (std::size_t at = text.find(word); at != text.npos; at = text.find(word, at + 1)) {
      const std::size_t body = text.find_first_of("{;#", at);
      if (body != text.npos && text[body] == '{') bodies.push_back(statementAt(text, body));
    }
  }
  return bodies;
}

// NVIDIA's compiler (580.159) leaves such a parameter as the loop's last turn would: peeling by layers delivered nothing there.
TEST(GlShaders, noLoopReturnsFromAFunctionWithOutParameters) {
  std::size_t bodies = 0;
  for (const gl::EmbeddedShader& shader : gl::embeddedShaders()) {
    for (const std::string_view body : bodiesWithOutParameters(shader.text)) {
      ++bodies;
      for (const char* loop : {"for (", "while ("}) {
        for (std::size_t at = body.find(loop); at != body.npos; at = body.find(loop, at + 1)) {
          const std::string_view turn = statementAt(body, closing(body, body.find('(', at)));
          EXPECT_EQ(turn.find("return"), turn.npos) << shader.path << ": " << turn;
        }
      }
    }
  }
  EXPECT_GE(bodies, 5u);
}

// Helper invocations wait for ever in a loop over lists that they cannot write: NVIDIA's GPUs hung.
TEST(GlShaders, pixelPassesKeepHelperInvocationsOut) {
  const Scene scene({{share(box({0, 0, 0}, {1, 1, 1}))}});
  const PlaneClasses planes(scene, 0);
  gl::Renderer renderer(scene, planes);
  renderer.setView(lookAt({3, 2, 4}, {0, 0, 0}, 16, 16, 0.02));
  renderer.setFold(folds()[0]);
  for (const MethodInfo& method : methods()) {
    if (method.draw) renderer.draw(method.draw, {.cull = true});
  }
  std::size_t pixelPasses = 0;
  for (const gl::Programs::Made& made : renderer.programs().all()) {
    if (made.vertexPath != "core/gl/pixels.vert.glsl") continue;
    ++pixelPasses;
    EXPECT_EQ(made.fragmentPath, "core/gl/pixels.glsl");
    std::vector<std::string> files;
    const std::string source = gl::shaderSource(made.fragmentPath, made.defines, files);
    EXPECT_LT(source.find("#define main pixelMain"), source.find("void main()"));
    EXPECT_LT(source.find("void main()"), source.find("#undef main"));
    EXPECT_NE(source.find("if (!gl_HelperInvocation) pixelMain();"), std::string::npos);
  }
  EXPECT_GT(pixelPasses, 20u);
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
