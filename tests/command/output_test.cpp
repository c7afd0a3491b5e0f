// Where results go, what is in them, and that a failure leaves nothing behind. Hard case 14, from outside.
#include <cmath>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>
#include <unistd.h>

#include "core/image/write_image.h"
#include "tests/command/program.h"

namespace copeel {
namespace {

using Output = ProgramTest;

using Words = std::vector<std::string>;

TEST_F(Output, IsNamedAfterTheInputInTheCurrentFolder) {
  std::filesystem::create_directory(folder_ / "sub");
  std::filesystem::rename(folder_ / "part.csg", folder_ / "sub" / "part.v2.csg");
  EXPECT_EQ(run({"csg", "sub/part.v2.csg"}).exitCode, 0);
  EXPECT_EQ(files(), (Words{"part.v2.png", "sub"}));
}

TEST_F(Output, NamesWithBlanksUtf8QuotesAndDashes) {
  for (const std::string name : {"two words", "größe 螺丝", "-dash", "it's \"so\"", "a:b", "$(x);&"}) {
    SCOPED_TRACE(name);
    std::filesystem::copy_file(folder_ / "part.csg", folder_ / (name + ".csg"));
    EXPECT_EQ(run({"csg", "--imgsize", "16,16", "--", name + ".csg"}).exitCode, 0);
    EXPECT_TRUE(std::filesystem::exists(folder_ / (name + ".png")));
  }
}

// Reading, too: a text of 4 MB becomes a tape of some 14 MB, and each binary STL of 10^5 triangles a mesh of 8 MB.
TEST_F(Output, MemoryBeyondTheLimitIsTheMachinesLimit) {
  if (kHasSanitizer) GTEST_SKIP() << kPastAnyLimit;
  std::string text = "group() {\n";
  for (int i = 0; i < 50000; ++i) text += "multmatrix([[1,0,0," + std::to_string(2 * i) + "],[0,1,0,1],[0,0,1,1],[0,0,0,1]]) { cube(1); }\n";
  write("long.csg", text + "}\n");
  const std::uint32_t count = 100000;
  std::string mesh(84 + std::size_t{50} * count, '\0');
  std::memcpy(mesh.data() + 80, &count, 4);
  // Corners in one place would be kept once.
  for (std::uint32_t i = 0; i < 9 * count; ++i) {
    const float coordinate = static_cast<float>(i);
    std::memcpy(mesh.data() + 84 + std::size_t{50} * (i / 9) + 12 + 4 * (i % 9), &coordinate, 4);
  }
  write("large.stl", mesh);
  for (const std::string input : {"long.csg", "large.stl"}) {
    const Outcome outcome = run({"csg", input, "--memory", "4M", "--threads", "1", "-o", "a.png", "--stats", "a.json"});
    expectFailure(outcome, 3);
    EXPECT_NE(outcome.standardError.find("not enough memory"), std::string::npos) << outcome.standardError;
  }
  EXPECT_EQ(run({"csg", "long.csg", "--memory", kAmpleMemory, "--imgsize", "16,16"}).exitCode, 0);
  EXPECT_EQ(files(), (Words{"large.stl", "long.csg", "long.png", "part.csg"}));
}

TEST_F(Output, StatsHoldTheContract) {
  ASSERT_EQ(run({"csg", "part.csg", "--stats", "s.json", "--imgsize", "120,90", "--frames", "2"}).exitCode, 0);
  const auto stats = nlohmann::json::parse(contentOf(folder_ / "s.json"));
  for (const char* key : {"method", "backend", "width", "height", "triangles", "leaves", "plane_classes", "fragments", "fragments_captured", "rh",
                          "depth_complexity_max", "coplanar_pixels", "cp", "overflow", "passes", "memory_bytes", "decided_exactly", "uncertain", "ms"}) {
    EXPECT_TRUE(stats.contains(key)) << key;
  }
  for (const char* key : {"load", "prepare", "frame_median", "frame_min", "total"}) EXPECT_TRUE(stats["ms"].contains(key)) << key;
  EXPECT_EQ(stats["width"], 120);
  EXPECT_EQ(stats["height"], 90);
  EXPECT_EQ(stats["leaves"], 2);
  EXPECT_EQ(stats["rh"], 1.0);
  EXPECT_LE(stats["ms"]["frame_min"], stats["ms"]["frame_median"]);
  EXPECT_LE(stats["ms"]["load"], stats["ms"]["total"]);
  EXPECT_GT(stats["memory_bytes"], 0);
}

TEST_F(Output, PictureDepthAndIdsAgreeOnWhatIsSeen) {
  ASSERT_EQ(run({"csg", "part.csg", "-o", "a.png", "--depth", "a.pfm", "--ids", "a.pgm", "--imgsize", "200,150"}).exitCode, 0);
  const Image<Rgb8> color = readPng((folder_ / "a.png").string());
  const Image<float> depth = readPfm((folder_ / "a.pfm").string());
  ASSERT_EQ(color.width, 200);
  ASSERT_EQ(depth.height, 150);
  int seen = 0;
  for (std::size_t i = 0; i < depth.pixels.size(); ++i) {
    const bool isBackground = color.pixels[i] == Rgb8{255, 255, 229};
    EXPECT_EQ(isBackground, std::isinf(depth.pixels[i])) << "pixel " << i;
    seen += !isBackground;
  }
  EXPECT_GT(seen, 5000);
  EXPECT_EQ(contentOf(folder_ / "a.pgm").substr(0, 2), "P5");
}

// Colours follow their files through an expression that names them in another order, and a name with a colon is a name.
TEST_F(Output, WhatIsFoundInAMeshIsSaid) {
  write("open.off", "OFF\n4 3 0\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n3 0 2 1\n3 0 1 3\n3 0 3 2\n");
  const Outcome found = run({"csg", "open.off", "-o", "a.png"});
  EXPECT_EQ(found.exitCode, 0);
  EXPECT_NE(found.standardError.find("open.off: not closed (3 boundary edges)"), std::string::npos) << found.standardError;
  write("empty.csg", "group();\n");
  const Outcome empty = run({"csg", "empty.csg", "-o", "b.png"});
  EXPECT_EQ(empty.exitCode, 0);
  EXPECT_NE(empty.standardError.find("empty.csg: there is nothing to draw"), std::string::npos) << empty.standardError;
  EXPECT_EQ(run({"csg", "open.off", "-o", "a.png", "--quiet"}).standardError, "");
}

TEST_F(Output, MeshesKeepTheirLook) {
  const std::string corners = "3 0 2 1\n3 0 1 3\n3 0 3 2\n3 1 2 3\n";
  write("a.off", "OFF\n4 4 0\n0 0 0\n10 0 0\n0 10 0\n0 0 10\n" + corners);
  write("b:c.off", "OFF\n4 4 0\n20 0 0\n30 0 0\n20 10 0\n20 0 10\n" + corners);
  ASSERT_EQ(run({"csg", "a.off:color=#ff0000", "b:c.off:color=#00f,alpha=1", "--expr", "B + A", "--shading", "none", "-o", "a.png", "--camera",
                 "15,0,0,90,0,0,120"})
                .exitCode,
            0);
  const Image<Rgb8> image = readPng((folder_ / "a.png").string());
  bool redLeft = false, blueRight = false, other = false;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const Rgb8 pixel = image.at(x, y);
      const bool isLeft = x < image.width / 2;
      if (pixel == Rgb8{255, 0, 0} && isLeft) redLeft = true;
      else if (pixel == Rgb8{0, 0, 255} && !isLeft) blueRight = true;
      else if (pixel != Rgb8{255, 255, 229}) other = true;
    }
  }
  EXPECT_TRUE(redLeft);
  EXPECT_TRUE(blueRight);
  EXPECT_FALSE(other);
}

// An alpha alone is color(alpha=...): the scheme's green shows where the mesh is subtracted.
TEST_F(Output, AnAlphaAloneLeavesTheColourToTheScheme) {
  const auto boxOff = [](int low, int high, int top) {
    std::string text = "OFF\n8 6 0\n";
    for (int i = 0; i < 8; ++i) text += fmt::format("{} {} {}\n", i & 1 ? high : low, i & 2 ? high : low, i & 4 ? top : low);
    return text + "4 0 2 3 1\n4 4 5 7 6\n4 0 1 5 4\n4 2 6 7 3\n4 0 4 6 2\n4 1 3 7 5\n";
  };
  write("a.off", boxOff(0, 10, 10));
  write("b.off", boxOff(2, 8, 12));
  const auto draw = [&](const char* tool, const char* picture) {
    EXPECT_EQ(run({"csg", "a.off", tool, "--expr", "A - B", "-q", "-o", picture}).exitCode, 0);
    return contentOf(folder_ / picture);
  };
  EXPECT_EQ(draw("b.off:alpha=1", "alpha.png"), draw("b.off", "plain.png"));
  EXPECT_NE(draw("b.off:alpha=0.5", "half.png"), contentOf(folder_ / "plain.png"));
}

TEST_F(Output, MoreLeavesThanIdsIsSaid) {
  std::string text;
  for (int i = 0; i < 65535; ++i) text += "cube(1);\n";
  write("many.csg", text);
  const Words drawing = {"csg", "many.csg", "--imgsize", "1,1", "--camera", "99,99,99,0,0,0,1", "-o", "a.png"};
  EXPECT_EQ(run(drawing).standardError.find("--ids"), std::string::npos);
  Words withIds = drawing;
  withIds.insert(withIds.end(), {"--ids", "a.pgm"});
  EXPECT_NE(run(withIds).standardError.find("there are 65535 leaves"), std::string::npos);
}

TEST_F(Output, EndingsInCapitalsAreTheSame) {
  write("part.CSG", contentOf(folder_ / "part.csg"));
  EXPECT_EQ(run({"csg", "part.csg", "-q", "-o", "a.png"}).exitCode, 0);
  EXPECT_EQ(run({"csg", "part.CSG", "-q", "-o", "b.png"}).exitCode, 0);
  EXPECT_EQ(contentOf(folder_ / "a.png"), contentOf(folder_ / "b.png"));
}

TEST_F(Output, DashIsStandardOutput) {
  const Outcome outcome = run({"csg", "part.csg", "-o", "-"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_EQ(outcome.standardOutput.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(files(), Words{"part.csg"});
}

TEST_F(Output, ThreadsDoNotChangeAByte) {
  ASSERT_EQ(run({"csg", "part.csg", "-o", "1.png", "--threads", "1", "--depth", "1.pfm"}).exitCode, 0);
  ASSERT_EQ(run({"csg", "part.csg", "-o", "3.png", "--threads", "3", "--depth", "3.pfm"}).exitCode, 0);
  EXPECT_EQ(contentOf(folder_ / "1.png"), contentOf(folder_ / "3.png"));
  EXPECT_EQ(contentOf(folder_ / "1.pfm"), contentOf(folder_ / "3.pfm"));
}

TEST_F(Output, BadInputsAreExitOne) {
  std::filesystem::create_directory(folder_ / "folder.csg");
  write("empty.stl", "");
  write("cut.csg", "difference() { cube(size = [1, 2");
  write("nonsense.csg", "\x7f" "ELF\x02\x01\x01");
  write("cut.off", "OFF\n8 6 0\n0 0 0\n");
  write("other.ply", "%PDF-1.4\n%\xe2\xe3\n");
  write("nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Words before = files();
  for (const char* name : {"missing.csg", "missing.stl", "folder.csg", "empty.stl", "cut.csg", "nonsense.csg", "cut.off", "other.ply", "nan.obj"}) {
    SCOPED_TRACE(name);
    const Outcome outcome = run({"csg", name});
    expectFailure(outcome, 1);
    EXPECT_NE(outcome.standardError.find(name), std::string::npos) << outcome.standardError;
  }
  EXPECT_EQ(files(), before);
}

TEST_F(Output, PlacesThatCannotBeWrittenAreExitThree) {
  std::filesystem::create_directory(folder_ / "folder.png");
  const Words before = files();
  expectFailure(run({"csg", "part.csg", "-o", "missing/a.png"}), 3);
  expectFailure(run({"csg", "part.csg", "-o", "folder.png"}), 3);
  expectFailure(run({"csg", "part.csg", "--stats", "missing/a.json"}), 3);
  EXPECT_EQ(files(), before);
}

TEST_F(Output, FullDiskIsExitThree) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const char* option : {"-o", "--depth", "--ids", "--stats"}) {
    SCOPED_TRACE(option);
    const Words picture = option == std::string("-o") ? Words{} : Words{"-o", "a.png"};
    Words words{"csg", "part.csg", option, "/dev/full"};
    words.insert(words.end(), picture.begin(), picture.end());
    expectFailure(run(words), 3);
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/full"));
  EXPECT_EQ(files(), Words{"part.csg"});
}

TEST_F(Output, NoPermissionIsExitThreeAndKeepsTheOld) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  write("a.png", "old");
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  expectFailure(run({"csg", "part.csg", "-o", "a.png"}), 3);
  std::filesystem::permissions(folder_, std::filesystem::perms::owner_all);
  EXPECT_EQ(contentOf(folder_ / "a.png"), "old");
}

TEST_F(Output, UnreadableInputIsExitOne) {
  if (geteuid() == 0) GTEST_SKIP() << "root may read anything";
  std::filesystem::permissions(folder_ / "part.csg", std::filesystem::perms::none);
  expectFailure(run({"csg", "part.csg"}), 1);
}

TEST_F(Output, FailureKeepsTheOldPicture) {
  write("a.png", "old");
  expectFailure(run({"csg", "part.csg", "-o", "a.png", "--stats", "/dev/full"}), 3);
  EXPECT_EQ(contentOf(folder_ / "a.png"), "old");
}

TEST_F(Output, LinksAreFollowed) {
  std::filesystem::create_directory(folder_ / "sub");
  std::filesystem::create_symlink("sub/real.png", folder_ / "link.png");
  write("sub/real.png", "old");
  ASSERT_EQ(run({"csg", "part.csg", "-o", "link.png"}).exitCode, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder_ / "link.png"));
  EXPECT_EQ(contentOf(folder_ / "sub/real.png").substr(1, 3), "PNG");
}

TEST_F(Output, AFaultOfTheSceneNamesTheFile) {
  write("far.csg", "multmatrix([[1e300,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(1);");
  const Outcome outcome = run({"csg", "far.csg"});
  expectFailure(outcome, 1);
  EXPECT_EQ(outcome.standardError.substr(0, 25), "copeel: far.csg: object 1");
}

TEST_F(Output, AnInputMayBeAPipe) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const std::string command = "cd '" + folder_.string() + "' && (printf 'v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3\\n' > pipe; echo $? > wrote) & cd '" +
                              folder_.string() + "' && timeout 20 '" + COPEEL_PROGRAM + "' csg pipe -q -o a.png; code=$?; wait; exit $code";
  EXPECT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(contentOf(folder_ / "wrote"), "0\n");
}

TEST_F(Output, TooLittleMemoryIsExitThree) {
  if (kHasSanitizer) GTEST_SKIP() << kPastAnyLimit;
  expectFailure(run({"csg", "part.csg", "--imgsize", "16384,16384", "--memory", "64M"}), 3);
  EXPECT_EQ(files(), Words{"part.csg"});
}

}  // namespace
}  // namespace copeel
