// The program ended from outside while it works: it dies as asked, and leaves nothing.
#include <chrono>
#include <csignal>
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
