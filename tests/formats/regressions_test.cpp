// Every file in regressions/ once broke a reader (its name says how). Each must be read or refused in one line, quickly.
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "core/error.h"
#include "core/formats/readers.h"

namespace copeel {
namespace {

constexpr double kLongestSeconds = 5;  // also under sanitizers

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Regressions, everyReaderAnswersEveryFile) {
  for (const auto& entry : std::filesystem::directory_iterator(COPEEL_REGRESSIONS)) {
    const std::string content = contentOf(entry.path());
    const Source source(content, entry.path().filename().string());
    for (Mesh (*read)(const Source&, const ReadMeshOptions&) : {readObj, readOff, readPly, readStl}) {
      const auto start = std::chrono::steady_clock::now();
      try {
        const Mesh mesh = read(source, {.colors = true});
        for (const glm::uvec3& t : mesh.triangles) ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.vertices.size());
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ExitCode::Input) << entry.path();
        EXPECT_EQ(std::string_view(error.what()).find('\n'), std::string_view::npos) << entry.path();
      }
      const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
      EXPECT_LT(seconds.count(), kLongestSeconds) << entry.path();
    }
  }
}

}  // namespace
}  // namespace copeel
