// The gl back end on machines that lack something: one line and exit code 3, never a crash; under --backend auto the cpu draws.
#include <cstdlib>

#include <gtest/gtest.h>

#include "core/image/write_image.h"
#include "tests/command/program.h"

namespace copeel {
namespace {

using Words = std::vector<std::string>;

// An environment variable for the programs that a test starts.
class Environment {
 public:
  Environment(const char* name, const std::string& value) : name_(name) { ::setenv(name, value.c_str(), 1); }
  ~Environment() { ::unsetenv(name_); }
  Environment(const Environment&) = delete;

 private:
  const char* name_;
};

class Machine : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("square.obj", "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\nf 1 2 3 4\n");
  }
  Outcome draw(const Words& more) {
    Words words = {"oit", "square.obj", "-o", "a.png", "--imgsize", "64,48"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  void expectNoGl() {
    expectFailure(draw({"--backend", "gl"}), 3);
    expectFailure(draw({"--method", "ll"}), 3);
    const Outcome outcome = draw({"--backend", "auto"});
    EXPECT_EQ(outcome.exitCode, 0);
    EXPECT_TRUE(outcome.standardError.empty()) << outcome.standardError;
  }
};

TEST_F(Machine, WithoutTheLibrariesOfGl) {
  for (const char* library : {"libEGL", "libepoxy"}) {
    const Environment order("ASAN_OPTIONS", "verify_asan_link_order=0");   // AddressSanitizer would have to be loaded first
    const Environment preload("LD_PRELOAD", COPEEL_HIDE_LIBRARY), hidden("HIDDEN_LIBRARY", library);
    expectNoGl();
    EXPECT_NE(draw({"--backend", "gl"}).standardError.find(library), std::string::npos);
  }
}

TEST_F(Machine, WithoutADriver) {
  {
    const Environment vendors("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent");
    expectNoGl();
  }
  const Environment drivers("LIBGL_DRIVERS_PATH", "/nonexistent");
  expectNoGl();
}

TEST_F(Machine, WithAnOldGl) {
  const Environment version("MESA_GL_VERSION_OVERRIDE", "3.3");
  expectNoGl();
}

// Whatever is not enough is said; what is enough draws the same picture. Drivers that are denied memory would end the program.
TEST_F(Machine, LittleMemory) {
  if (kHasSanitizer) GTEST_SKIP() << kPastAnyLimit;
  ASSERT_EQ(draw({"--backend", "gl"}).exitCode, 0);
  const auto expected = readPng((folder_ / "a.png").string()).pixels;
  int enough = 0;
  for (const char* memory : {"16M", "24M", "96M"}) {
    for (const char* method : {"auto", "hybrid", "kb"}) {
      const Outcome outcome = draw({"--backend", "gl", "--method", method, "--memory", memory});
      if (outcome.exitCode != 0) {
        expectFailure(outcome, 3);
        continue;
      }
      ++enough;
      EXPECT_EQ(readPng((folder_ / "a.png").string()).pixels, expected) << memory << ", " << method;
    }
  }
  EXPECT_GE(enough, 6);
  expectFailure(run({"oit", "square.obj", "-o", "a.png", "--method", "hybrid", "--memory", "40M"}), 3);   // 512 x 512 pixels of 268 bytes
}

// 64 x 48 pixels with 240 bytes of state take 0.7 MB of these 20; 2 million fragments want 25 for lists.
TEST_F(Machine, WhatFindsNoRoomIsSaid) {
  if (kHasSanitizer) GTEST_SKIP() << kPastAnyLimit;
  write("deep.obj", [] {
    std::string text = "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\n";
    for (int i = 0; i < 700; ++i) text += "f 1 2 3 4\n";
    return text;
  }());
  const Outcome outcome = run({"oit", "deep.obj", "-o", "a.png", "--imgsize", "64,48", "--method", "ll", "--memory", "20M", "--camera=0.1,0.2,0,0,0,0,10"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_NE(outcome.standardError.find("found no room and are missing"), std::string::npos) << outcome.standardError;
}

}  // namespace
}  // namespace copeel
