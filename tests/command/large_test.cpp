// Hard case 15 through the program as a user runs it: many leaves, one leaf many times, deep trees, a leaf of 10^7 triangles. Seconds and bytes
// are printed, not judged, but for the bytes a triangle takes. Slow: half a gigabyte is written and read.
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <numbers>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/command/program.h"

namespace copeel {
namespace {

class Large : public ProgramTest {
 protected:
  nlohmann::json drawn(const std::string& input) {
    const Outcome outcome = run({"csg", input, "-q", "-o", "a.png", "--stats", "a.json"});
    EXPECT_EQ(outcome.exitCode, 0) << outcome.standardError;
    if (outcome.exitCode != 0) return {};
    const auto stats = nlohmann::json::parse(contentOf(folder_ / "a.json"));
    fmt::print("{}: {} triangles, {} leaves, {:.2f} s, {} MB\n", input, stats["triangles"].get<std::uint64_t>(), stats["leaves"].get<std::uint64_t>(),
               stats["ms"]["total"].get<double>() / 1000, stats["memory_bytes"].get<std::uint64_t>() >> 20);
    return stats;
  }
};

constexpr int kLeaves = 100000;

std::string placedAt(int i) { return fmt::format("multmatrix([[1,0,0,{}],[0,1,0,{}],[0,0,1,0],[0,0,0,1]]) ", 2 * (i % 316), 2 * (i / 316)); }

TEST_F(Large, OneLeafUsed100000Times) {
  std::string text;
  for (int i = 0; i < kLeaves; ++i) text += placedAt(i) + "cube(1);\n";
  write("many.csg", text);
  EXPECT_EQ(drawn("many.csg")["leaves"], kLeaves);
}

TEST_F(Large, LeavesOf100000Shapes) {
  std::string text = "difference() { cube([640,640,1.5]);\n";
  for (int i = 0; i < kLeaves; ++i) text += placedAt(i) + fmt::format("cube([1,1,{}]);\n", 2 + i * 1e-5);
  write("many.csg", text + "}");
  EXPECT_EQ(drawn("many.csg")["leaves"], kLeaves + 1);
}

// The difference of a difference of a …: left-deep a long bar with bites, right-deep shells within shells.
TEST_F(Large, DifferencesNested10000Deep) {
  std::string left, right, close;
  for (int i = 0; i < 10000; ++i) {
    left += "difference() {";
    right += fmt::format("difference() {{ cube({}, center=true);", 10001 - i);
    close += fmt::format("multmatrix([[1,0,0,{}],[0,1,0,0],[0,0,1,0],[0,0,0,1]]) cube(0.5); }}", i);
  }
  write("left.csg", left + "cube([10010,1,1]);" + close);
  write("right.csg", right + std::string(10000, '}'));
  EXPECT_EQ(drawn("left.csg")["leaves"], 10001);
  EXPECT_EQ(drawn("right.csg")["leaves"], 10000);
}

// A torus of `around` × `across` quads.
struct Torus {
  std::uint32_t around = 2500, across = 2000;

  std::uint32_t triangleCount() const { return 2 * around * across; }
  std::array<float, 3> point(std::uint32_t i, std::uint32_t j) const {
    const double a = 2 * std::numbers::pi * (i % around) / around, b = 2 * std::numbers::pi * (j % across) / across;
    const double r = 30 + 10 * std::cos(b);
    return {static_cast<float>(r * std::cos(a)), static_cast<float>(r * std::sin(a)), static_cast<float>(10 * std::sin(b))};
  }
  // Calls visit with the (i, j) of the three corners of each triangle.
  template <class Visit>
  void forEachTriangle(Visit visit) const {
    using Corner = std::array<std::uint32_t, 2>;
    for (std::uint32_t i = 0; i < around; ++i) {
      for (std::uint32_t j = 0; j < across; ++j) {
        visit(Corner{i, j}, Corner{i + 1, j}, Corner{i + 1, j + 1});
        visit(Corner{i, j}, Corner{i + 1, j + 1}, Corner{i, j + 1});
      }
    }
  }
};

template <class T>
void put(std::ofstream& file, const T& value) {
  file.write(reinterpret_cast<const char*>(&value), sizeof value);
}

static_assert(std::endian::native == std::endian::little, "binary files are written as they lie in memory");

TEST_F(Large, AMeshOfTenMillionTriangles) {
  const Torus torus;
  {
    std::ofstream file(folder_ / "torus.ply", std::ios::binary);
    file << fmt::format(
        "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
        "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
        torus.around * torus.across, torus.triangleCount());
    for (std::uint32_t i = 0; i < torus.around; ++i) {
      for (std::uint32_t j = 0; j < torus.across; ++j) put(file, torus.point(i, j));
    }
    torus.forEachTriangle([&](auto... corners) {
      put(file, std::uint8_t{3});
      (put(file, corners[0] % torus.around * torus.across + corners[1] % torus.across), ...);
    });
  }
  const auto stats = drawn("torus.ply");
  EXPECT_EQ(stats["triangles"], torus.triangleCount());
  EXPECT_LE(stats["memory_bytes"].get<double>(), 150.0 * torus.triangleCount() + (64 << 20));
}

// Every triangle is written with three vertices of its own.
TEST_F(Large, ASoupOfTenMillionTriangles) {
  const Torus torus;
  {
    std::ofstream file(folder_ / "torus.stl", std::ios::binary);
    file << std::string(80, ' ');
    put(file, torus.triangleCount());
    torus.forEachTriangle([&](auto... corners) {
      put(file, std::array<float, 3>{});
      (put(file, torus.point(corners[0], corners[1])), ...);
      put(file, std::uint16_t{0});
    });
  }
  const auto stats = drawn("torus.stl");
  EXPECT_EQ(stats["triangles"], torus.triangleCount());
  EXPECT_LE(stats["memory_bytes"].get<double>(), 150.0 * torus.triangleCount() + (64 << 20));
}

// The values of the text, 16 bytes each, are held until the mesh is made of them.
TEST_F(Large, APolyhedronOfAMillionTriangles) {
  const Torus torus{1000, 500};
  std::string text = "polyhedron(points = [";
  for (std::uint32_t i = 0; i < torus.around; ++i) {
    for (std::uint32_t j = 0; j < torus.across; ++j) {
      const auto p = torus.point(i, j);
      text += fmt::format("[{}, {}, {}], ", p[0], p[1], p[2]);
    }
  }
  text += "], faces = [";
  torus.forEachTriangle([&](auto a, auto b, auto c) {
    const auto index = [&](const auto& corner) { return corner[0] % torus.around * torus.across + corner[1] % torus.across; };
    text += fmt::format("[{}, {}, {}], ", index(a), index(c), index(b));
  });
  write("torus.csg", text + "], convexity = 1);\n");
  const auto stats = drawn("torus.csg");
  EXPECT_EQ(stats["triangles"], torus.triangleCount());
  EXPECT_LE(stats["memory_bytes"].get<double>(), 150.0 * torus.triangleCount() + (64 << 20));
}

}  // namespace
}  // namespace copeel
