// The program ended from outside while it works: it dies as asked, and leaves nothing.
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "tests/command/program.h"

namespace copeel {
namespace {

using Interrupt = ProgramTest;
using namespace std::chrono_literals;

TEST_F(Interrupt, SignalsEndTheDrawingAndLeaveNothing) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    Program program(folder_, {"csg", "part.csg", "-o", "a.png", "--depth", "a.pfm", "--frames", "1000000"});
    std::this_thread::sleep_for(300ms);
    program.send(signal);
    const Outcome outcome = program.finish();
    EXPECT_EQ(outcome.signal, signal);
    EXPECT_EQ(files(), std::vector<std::string>{"part.csg"});
  }
}

// At whatever moment the signal comes, also while files are being written: old content, whole new content, or no file.
TEST_F(Interrupt, AtAnyMomentFilesAreWhole) {
  for (int delay = 0; delay < 60; delay += 3) {
    Program program(folder_, {"csg", "part.csg", "-o", "a.png", "--depth", "a.pfm", "--imgsize", "1000,1000"});
    std::this_thread::sleep_for(std::chrono::milliseconds(delay));
    program.send(SIGINT);
    program.finish();
    for (const std::string& name : files()) {
      SCOPED_TRACE(name);
      if (name == "part.csg") continue;
      const std::string content = contentOf(folder_ / name);
      if (name == "a.pfm") {
        EXPECT_GT(content.size(), 4000000u);
      } else {
        ASSERT_EQ(name, "a.png");
        EXPECT_EQ(content.substr(content.size() - 8, 4), "IEND");
      }
    }
  }
}

// While openscad runs, its files lie in a temporary folder.
TEST_F(Interrupt, OpenscadsTemporaryFolderGoes) {
  std::filesystem::create_directory(folder_ / "tmp");
  write("slow.scad", "function f(n) = n < 2 ? n : f(n - 1) + f(n - 2);\ncube(f(40));\n");
  const std::optional<std::string> before = std::getenv("TMPDIR") ? std::optional<std::string>(std::getenv("TMPDIR")) : std::nullopt;
  setenv("TMPDIR", (folder_ / "tmp").c_str(), 1);
  Program program(folder_, {"csg", "slow.scad", "-o", "a.png"});
  before ? setenv("TMPDIR", before->c_str(), 1) : unsetenv("TMPDIR");
  // The folder is there from before openscad starts; by the time it is seen with a log in it, the program is waiting.
  const auto hasLog = [&] {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder_ / "tmp")) {
      if (entry.path().filename() == "log") return true;
    }
    return false;
  };
  for (int i = 0; i < 500 && !hasLog(); ++i) std::this_thread::sleep_for(10ms);
  EXPECT_TRUE(hasLog());
  program.send(SIGINT);
  EXPECT_EQ(program.finish().signal, SIGINT);
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "tmp"));
}

// Not for the shell alone, which sends an interrupt to all of them: who ends copeel by its number ends openscad too.
TEST_F(Interrupt, OpenscadGoesToo) {
  const std::string path = std::getenv("PATH") ? std::getenv("PATH") : "/usr/bin:/bin";
  write("openscad", "#!/bin/sh\necho $$ >id.tmp\nmv id.tmp id\nexec sleep 60\n");
  std::filesystem::permissions(folder_ / "openscad", std::filesystem::perms::owner_all);
  write("part.scad", "cube(1);");
  write("hull.csg", "hull() { cube(1); }");
  for (const std::string input : {"part.scad", "hull.csg"}) {
    setenv("PATH", (folder_.string() + ":" + path).c_str(), 1);
    Program program(folder_, {"csg", input, "-o", "a.png"});
    setenv("PATH", path.c_str(), 1);
    for (int i = 0; i < 500 && !std::filesystem::exists(folder_ / "id"); ++i) std::this_thread::sleep_for(10ms);
    const pid_t openscad = std::stoi(contentOf(folder_ / "id"));
    std::filesystem::remove(folder_ / "id");
    EXPECT_EQ(kill(openscad, 0), 0);
    program.send(SIGTERM);
    EXPECT_EQ(program.finish().signal, SIGTERM);
    // It is no child of ours: whoever takes in orphans may take a moment, and a zombie still has a number.
    const auto runs = [&] {
      const std::string status = contentOf("/proc/" + std::to_string(openscad) + "/stat");
      return !status.empty() && status.find(") Z ") == std::string::npos;
    };
    for (int i = 0; i < 500 && runs(); ++i) std::this_thread::sleep_for(10ms);
    EXPECT_FALSE(runs()) << input;
  }
}

TEST_F(Interrupt, BrokenPipeIsOneLine) {
  Program program(folder_, {"csg", "part.csg", "-o", "-", "--imgsize", "3000,3000"});
  program.closeStandardOutput();
  expectFailure(program.finish(), 3);
  Program list(folder_, {"methods"});
  list.closeStandardOutput();
  expectFailure(list.finish(), 3);
}

}  // namespace
}  // namespace copeel
