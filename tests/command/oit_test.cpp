// copeel oit from outside: whose colour and opacity a mesh gets, and what is written.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/image/write_image.h"
#include "tests/command/program.h"

namespace copeel {
namespace {

using Words = std::vector<std::string>;

// A square that fills the picture, seen from above; unlit on black.
class Oit : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    const std::string vertices = "v -9 -9 0\nv 9 -9 0\nv 9 9 0\nv -9 9 0\n";
    write("plain.obj", vertices + "f 1 2 3 4\n");
    write("green.obj", "mtllib looks.mtl\n" + vertices + "usemtl green\nf 1 2 3 4\n");
    write("lost.obj", "mtllib gone.mtl\n" + vertices + "usemtl green\nf 1 2 3 4\n");
    write("looks.mtl", "newmtl green\nKd 0 0.8 0\nd 0.25\n");
  }
  Rgb8 middle(const Words& words, const std::string& shading = "none") {
    Words all = {"oit", "-o", "a.png", "--imgsize", "9,9", "--camera=0.1,0.2,0,0,0,0,10", "--shading", shading, "--background", "#000000"};
    all.insert(all.end(), words.begin(), words.end());
    const Outcome outcome = run(all);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.standardError;
    said_ = outcome.standardError;
    return readPng((folder_ / "a.png").string()).at(4, 4);
  }
  std::string said_;
};

TEST_F(Oit, TheLookOnTheCommandLineComesBeforeTheFiles) {
  EXPECT_EQ(middle({"green.obj"}), (Rgb8{0, 51, 0}));
  EXPECT_EQ(middle({"green.obj", "--alpha", "1"}), (Rgb8{0, 204, 0}));
  EXPECT_EQ(middle({"green.obj", "--color", "#c80000"}), (Rgb8{50, 0, 0}));
  EXPECT_EQ(middle({"green.obj:alpha=0.5", "--alpha", "1", "--color", "#c80000"}), (Rgb8{100, 0, 0}));
  EXPECT_EQ(middle({"plain.obj"}), (Rgb8{115, 80, 0}));   // the palette's first, half transparent
  EXPECT_EQ(middle({"plain.obj:alpha=0", "plain.obj:color=#0000ff,alpha=1"}), (Rgb8{0, 0, 255}));
}

TEST_F(Oit, CoplanarMeshesBlendInTheOrderOfTheCommandLine) {
  EXPECT_EQ(middle({"plain.obj:color=#c80000", "plain.obj:color=#00c800"}), (Rgb8{50, 100, 0}));
  EXPECT_EQ(middle({"plain.obj:color=#00c800", "plain.obj:color=#c80000"}), (Rgb8{100, 50, 0}));
}

// The square faces the eye: a light straight ahead gives its whole strength, one 3:4 aside 4/5 of it, and 0.2 are there anyway.
TEST_F(Oit, LightsAddUpAndEachChannelStopsAtItsLimit) {
  for (const char* command : {"oit", "csg"}) {
    const auto lit = [&](Words lights) {
      Words all = {command, "plain.obj:color=#c86432,alpha=1", "-o", "a.png", "--imgsize", "9,9", "--camera=0.1,0.2,0,0,0,0,10"};
      all.insert(all.end(), lights.begin(), lights.end());
      const Outcome outcome = run(all);
      EXPECT_EQ(outcome.exitCode, 0) << outcome.standardError;
      return readPng((folder_ / "a.png").string()).at(4, 4);
    };
    EXPECT_EQ(lit({"--light", "0,0,1,0.5"}), (Rgb8{140, 70, 35})) << command;
    EXPECT_EQ(lit({"--light", "0,0,1,0.5", "--light", "-3,0,4,0.25"}), (Rgb8{180, 90, 45})) << command;
    EXPECT_EQ(lit({"--light", "0,0,-1e200,0.5"}), (Rgb8{140, 70, 35})) << command;      // both sides of a face alike
    EXPECT_EQ(lit({"--light", "1,0,0"}), (Rgb8{40, 20, 10})) << command;
    EXPECT_EQ(lit({"--light", "0,0,1", "--light", "0,0,2"}), (Rgb8{255, 220, 110})) << command;
    EXPECT_EQ(lit({"--light", "-1,1,1"}), lit({})) << command;
  }
}

TEST_F(Oit, AMissingLibraryIsAWarning) {
  EXPECT_EQ(middle({"lost.obj"}), (Rgb8{115, 80, 0}));
  EXPECT_EQ(said_, "copeel: warning: lost.obj:1: no material library gone.mtl: its colours are missing\n");
  middle({"lost.obj", "--quiet"});
  EXPECT_TRUE(said_.empty());
}

TEST_F(Oit, WritesEverythingItIsAskedFor) {
  middle({"green.obj", "plain.obj", "plain.obj:alpha=1", "--depth", "a.pfm", "--ids", "a.pgm", "--layers", "l.pgm", "--coplanar", "c.pgm", "--stats", "a.json",
          "--samples", "4", "--frames", "3", "--threads", "2", "--memory", kAmpleMemory});
  const auto stats = nlohmann::json::parse(contentOf(folder_ / "a.json"));
  EXPECT_EQ(stats["leaves"], 3);
  EXPECT_EQ(stats["plane_classes"], 1);
  EXPECT_EQ(stats["depth_complexity_max"], 3);
  EXPECT_EQ(stats["cp"], 1.0);
  EXPECT_EQ(stats["rh"], 1.0);
  EXPECT_NEAR(readPfm((folder_ / "a.pfm").string()).at(4, 4), 10, 1e-5);
  const std::string head = "P5\n9 9\n65535\n", three("\0\3", 2);
  for (const char* name : {"a.pgm", "l.pgm", "c.pgm"}) {
    const std::string content = contentOf(folder_ / name);
    EXPECT_EQ(content.substr(head.size() + 2 * 40, 2), three) << name;
  }
}

}  // namespace
}  // namespace copeel
