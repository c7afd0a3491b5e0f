// What each format may say, and that all of it arrives.
#include <cmath>
#include <gtest/gtest.h>

#include "mesh_texts.h"

namespace copeel {
namespace {

const std::string kPlyVertices = "element vertex 3\nproperty double x\nproperty double y\nproperty double z\n";

TEST(Off, readsCountsVerticesAndFaces) {
  const Mesh mesh = meshOf("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0.1\n3 0 1 2\n");
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[2], glm::dvec3(0, 1, 0.1));
  ASSERT_EQ(mesh.triangles.size(), 1u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_FALSE(mesh.singlePrecision);
}

TEST(Off, everyVariantBeginsItsVerticesWithThePosition) {
  for (const char* text :
       {"COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 255 0 0 255\n0 1 0 0 0 0 0\n3 0 1 2 1 0 0\n",
        "NOFF 3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n",
        "STOFF\n3 1\n0 0 0 0.5 0.5\n1 0 0 0 0\n0 1 0 1 1\n3 0 1 2",
        "STCNOFF\r\n# a comment\r\n\r\n3 1 0\r\n0 0 0 0 0 1 1 1 1 1 0 0\r\n1 0 0\r\n0 1 0 # another\r\n3 0 1 2\r\n",
        "OFF3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
        "# first\nOFF 3 1 0\n0 0 0\n+1 0 0\n0 1e0 0\n3 0 1 2 0.5 0.5 0.5 1\n",
        "\xef\xbb\xbfOFF 3 1 0\r0 0 0\r1 0 0\r0 1 0\r3 0 1 2\r"}) {
    const Mesh mesh = meshOf(text);
    ASSERT_EQ(mesh.vertices.size(), 3u) << text;
    EXPECT_EQ(mesh.vertices[1], glm::dvec3(1, 0, 0)) << text;
    EXPECT_EQ(mesh.triangles.size(), 1u) << text;
  }
}

TEST(Off, edgesAndPointsLeaveNoTriangle) {
  EXPECT_EQ(meshOf("OFF 3 3 0\n0 0 0\n1 0 0\n0 1 0\n1 0\n2 0 1\n0\n").triangles.size(), 0u);
}

TEST(Off, noFacesIsAMeshWithoutTriangles) {
  EXPECT_EQ(meshOf("OFF\n0 0 0\n").triangles.size(), 0u);
  EXPECT_EQ(meshOf("OFF\n1 0 0\n5 5 5\n").vertices.size(), 1u);
}

TEST(Obj, readsAllWaysToNameAVertex) {
  const Mesh mesh = meshOf(
      "# x\nmtllib a.mtl\no cube\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.5 0.5 0.5\nvt 0 0\nvn 0 0 1\ng a\ns off\n"
      "f 1 2 3\nf 1/1 2/1 3/1\nf 1//1 2//1 3//1\nf 1/1/1 2/1/1 3/1/1\nf -3 -2 -1\nl 1 2\np 1\nf 1 2 \\\n 3\nusemtl b");
  EXPECT_EQ(mesh.vertices.size(), 3u);
  ASSERT_EQ(mesh.triangles.size(), 6u);
  for (const glm::uvec3& t : mesh.triangles) EXPECT_EQ(t, glm::uvec3(0, 1, 2));
}

TEST(Obj, negativeIndicesCountBackFromTheirOwnLine) {
  const Mesh mesh = meshOf("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nf -1 1 2\n");
  ASSERT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(3, 0, 1));
}

TEST(Obj, facesMayComeBeforeTheirVertices) {
  EXPECT_EQ(meshOf("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n").triangles.size(), 1u);
}

TEST(Obj, nothingButCommentsIsAMeshWithoutTriangles) { EXPECT_EQ(meshOf("# nothing\n").triangles.size(), 0u); }

TEST(Stl, asciiKeepsDoublesAndSeveralSolids) {
  const std::string facet =
      "facet normal nan nan nan\n outer loop\n vertex 0.1 0 0\n vertex 1 0 0\n vertex 0 1 0\n endloop\n endfacet\n";
  const Mesh mesh =
      meshOf("solid a name with spaces\n" + facet + "endsolid a\nSOLID\r\n" + facet + facet + "ENDSOLID\n");
  // The same facet three times is three faces on three vertices.
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0].x, 0.1);
  EXPECT_FALSE(mesh.singlePrecision);
  EXPECT_EQ(meshOf("solid\nendsolid\n").triangles.size(), 0u);
}

TEST(Stl, verticesAreSharedWhereTheyAreTheSameToTheBit) {
  const auto facet = [](double x) { return fmt::format("facet normal 0 0 0\nouter loop\nvertex {} 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n", x); };
  const Mesh mesh = meshOf("solid\n" + facet(0.5) + facet(std::nextafter(0.5, 1)) + facet(0.0) + facet(-0.0) + facet(0.5) + "endsolid\n");
  EXPECT_EQ(mesh.triangles.size(), 5u);
  EXPECT_EQ(mesh.vertices.size(), 6u);
  EXPECT_EQ(mesh.triangles[4], mesh.triangles[0]);
  EXPECT_TRUE(std::signbit(mesh.vertices[mesh.triangles[3].x].x));
}

std::string binaryStl(std::string header, std::uint32_t count) {
  header.resize(80, '\0');
  std::string bytes = header + bytesOf(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    for (const float value : {0.f, 0.f, 1.f, 0.1f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) bytes += bytesOf(value);
    bytes += "ab";
  }
  return bytes;
}

TEST(Stl, binaryIsKnownByItsSizeEvenWhenItSaysSolid) {
  for (const char* header :
       {"", "solid", "solid exported by a well-known program, padded with blanks                      "}) {
    const Mesh mesh = meshOf(binaryStl(header, 2));
    ASSERT_EQ(mesh.triangles.size(), 2u);
    EXPECT_TRUE(mesh.singlePrecision);
    EXPECT_EQ(mesh.vertices[0].x, double{0.1f});
  }
  EXPECT_EQ(meshOf(binaryStl("", 0)).triangles.size(), 0u);
}

TEST(Ply, asciiWithPropertiesInAnyOrderAndOtherElements) {
  const Mesh mesh = meshOf(
      "ply\r\nformat ascii 1.0\r\ncomment x\r\nobj_info y\r\nelement camera 1\r\nproperty list uchar float "
      "odd\r\nproperty int n\r\n"
      "element vertex 3\r\nproperty uchar red\r\nproperty double z\r\nproperty list int8 int16 extra\r\nproperty "
      "double x\r\nproperty int y\r\n"
      "element face 1\r\nproperty float q\r\nproperty list ushort uint32 vertex_index\r\nproperty uchar "
      "f\r\nend_header\r\n"
      "2 0.5 nan 7\r\n255 0.1 2 9 9 1 5\r\n0 0 0 2 6\r\n0 0 1 3 4 7\r\n0.5 3 0 1 2 9\r\n");
  ASSERT_EQ(mesh.vertices.size(), 3u);
  EXPECT_EQ(mesh.vertices[0], glm::dvec3(1, 5, 0.1));
  EXPECT_EQ(mesh.vertices[2], glm::dvec3(4, 7, 0));
  EXPECT_EQ(mesh.triangles.size(), 1u);
  EXPECT_FALSE(mesh.singlePrecision);
}

template <class Index, class Count>
std::string binaryPly(const std::string& listTypes, bool bigEndian) {
  std::string bytes = std::string("ply\nformat binary_") + (bigEndian ? "big" : "little") + "_endian 1.0\n" +
                      kPlyVertices + "element face 2\nproperty list " + listTypes + " vertex_indices\nend_header\n";
  for (const double value : {10.0, 0.0, 0.0, 1.0, 0.1, 0.0, 0.0, 1.0, -5e-324}) bytes += bytesOf(value, bigEndian);
  for (int face = 0; face < 2; ++face) {
    bytes += bytesOf(Count{3}, bigEndian);
    for (const int i : {2, 0, 1}) bytes += bytesOf(static_cast<Index>(i), bigEndian);
  }
  return bytes;
}

TEST(Ply, binaryOfBothByteOrdersAndAllIntegerTypes) {
  for (const bool bigEndian : {false, true}) {
    for (const std::string& bytes : {binaryPly<std::int8_t, std::int8_t>("char int8", bigEndian),
                                     binaryPly<std::uint8_t, std::uint16_t>("ushort uchar", bigEndian),
                                     binaryPly<std::int16_t, std::int32_t>("int short", bigEndian),
                                     binaryPly<std::uint16_t, std::uint8_t>("uint8 uint16", bigEndian),
                                     binaryPly<std::int32_t, std::int16_t>("int16 int", bigEndian),
                                     binaryPly<std::uint32_t, std::uint32_t>("uint uint", bigEndian)}) {
      const Mesh mesh = meshOf(bytes);
      ASSERT_EQ(mesh.vertices.size(), 3u);
      EXPECT_EQ(mesh.vertices[0], glm::dvec3(10, 0, 0));
      EXPECT_EQ(mesh.vertices[2].z, -5e-324);
      ASSERT_EQ(mesh.triangles.size(), 2u);
      EXPECT_EQ(mesh.triangles[1], glm::uvec3(2, 0, 1));
      EXPECT_FALSE(mesh.singlePrecision);
    }
  }
}

TEST(Ply, bodyMayBeginWithALineEnd) {
  // 10 is \n as an 8-bit coordinate; only the header's own line end may be taken.
  for (const std::string lineEnd : {"\n", "\r\n"}) {
    std::string header;
    for (const char* line : {"ply", "format binary_little_endian 1.0", "element vertex 1", "property char x",
                             "property char y", "property char z", "end_header"}) {
      header += line + lineEnd;
    }
    EXPECT_EQ(meshOf(header + "\n\r\n").vertices.at(0), glm::dvec3(10, 13, 10));
  }
}

TEST(Ply, floatPropertiesAreSinglePrecision) {
  EXPECT_TRUE(meshOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float "
                     "z\nend_header\n1 2 3\n")
                  .singlePrecision);
}

TEST(Ply, facesMayComeBeforeTheirVertices) {
  EXPECT_EQ(meshOf("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\n" + kPlyVertices +
                   "end_header\n3 0 1 2\n0 0 0\n1 0 0\n0 1 0\n")
                .triangles.size(),
            1u);
}

TEST(Ply, stripsAlternateAndRestart) {
  const Mesh mesh = meshOf(
      "ply\nformat ascii 1.0\nelement vertex 5\nproperty int x\nproperty int y\nproperty int z\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n2 2 0\n8 0 1 2 3 -1 2 3 4\n");
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 2));
  EXPECT_EQ(mesh.triangles[1], glm::uvec3(2, 1, 3));
  EXPECT_EQ(mesh.triangles[2], glm::uvec3(2, 3, 4));
}

TEST(Ply, zeroElementsNeedNoProperties) {
  EXPECT_EQ(meshOf("ply\nformat ascii 1.0\nelement vertex 0\nelement face 0\nend_header\n").triangles.size(), 0u);
  EXPECT_EQ(meshOf("ply\nformat ascii 1.0\nend_header").vertices.size(), 0u);
}

TEST(Numbers, extremesThatAreFiniteStay) {
  const Mesh mesh = meshOf(
      "v 1e308 -1.7976931348623157e308 5e-324\nv 1e-400 -1e-5000 0.0000000000000000000000000000000000000000001e-300\n");
  EXPECT_EQ(mesh.vertices[0], glm::dvec3(1e308, -1.7976931348623157e308, 5e-324));
  EXPECT_EQ(mesh.vertices[1], glm::dvec3(0, 0, 0));
}

}  // namespace
}  // namespace copeel
