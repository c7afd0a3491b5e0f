// The colours that files give, face by face, and what is said of those that cannot be had.
#include <gtest/gtest.h>

#include "mesh_texts.h"
#include "tests/temporary_folder.h"

namespace copeel {
namespace {

constexpr float kNone = Mesh::kNotGiven;
using Colors = std::vector<glm::vec4>;

Mesh coloredOf(std::string_view text) { return readMeshFromMemory(text, "m", {.colors = true}); }

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

struct Read {
  Mesh mesh;
  std::vector<std::string> warnings;
};
Read readObjWith(const std::string& obj, const std::string& mtl) {
  const TemporaryFolder folder;
  if (!mtl.empty()) folder.write("some looks.mtl", mtl);
  Read read;
  read.mesh = readMesh(folder.write("m.obj", obj), {.colors = true, .warnings = &read.warnings});
  return read;
}

TEST(ObjColors, materialsColourTheFacesAfterThem) {
  const Read read = readObjWith("mtllib some looks.mtl\n" + kVertices + "f 1 2 3\nusemtl glass\nf 1 2 3 4\nusemtl tin can \nf 3 2 1\nusemtl dark\nf 1 3 4\n",
                                "# looks\nnewmtl glass\nKa 1 1 1\nKd 0.2 0.4 2\nd 0.25\nnewmtl tin can\nKd 1\nnewmtl dark\r\nTr 0.75\r\n");
  EXPECT_EQ(read.mesh.colors, (Colors{{kNone, kNone, kNone, kNone}, {51, 102, 255, 0.25f}, {51, 102, 255, 0.25f}, {255, 255, 255, 1}, {kNone, kNone, kNone, 0.25f}}));
  EXPECT_TRUE(read.warnings.empty());
}

TEST(ObjColors, aLibraryMayBeginWithAByteOrderMark) {
  const Read read = readObjWith("\xef\xbb\xbfmtllib some looks.mtl\n" + kVertices + "usemtl glass\nf 1 2 3\n", "\xef\xbb\xbfnewmtl glass\nKd 1 0 0\n");
  EXPECT_EQ(read.mesh.colors, (Colors{{255, 0, 0, 1}}));
  EXPECT_TRUE(read.warnings.empty());
}

TEST(ObjColors, whatIsMissingIsNamed) {
  const Read library = readObjWith("mtllib gone.mtl\n" + kVertices + "usemtl glass\nf 1 2 3\n", "");
  ASSERT_EQ(library.warnings.size(), 1u);
  EXPECT_NE(library.warnings[0].find("m.obj:1: no material library gone.mtl"), std::string::npos) << library.warnings[0];
  const Read material = readObjWith("mtllib some looks.mtl\n" + kVertices + "usemtl glas\nf 1 2 3\nusemtl glas\nf 1 2 4\n", "newmtl glass\nKd 1 0 0\n");
  ASSERT_EQ(material.warnings.size(), 1u);
  EXPECT_NE(material.warnings[0].find("m.obj:6: no material glas "), std::string::npos) << material.warnings[0];
  EXPECT_EQ(material.mesh.colors, Colors(2, glm::vec4(kNone)));
}

TEST(ObjColors, aFaultInTheLibraryNamesItsLine) {
  try {
    readObjWith("mtllib some looks.mtl\n" + kVertices, "newmtl a\nKd 1 x 0\n");
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ExitCode::Input);
    EXPECT_NE(std::string(error.what()).find("some looks.mtl:2: "), std::string::npos) << error.what();
  }
}

TEST(ObjColors, areNotReadUnlessAsked) {
  EXPECT_TRUE(meshOf("mtllib gone.mtl\n" + kVertices + "usemtl a\nf 1 2 3\n").colors.empty());
  EXPECT_TRUE(coloredOf(kVertices + "f 1 2 3\n").colors.empty());
}

std::string ply(const std::string& vertexColors, const std::string& faceColors, const std::string& body) {
  return "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n" + vertexColors +
         "element face 2\nproperty list uchar int vertex_indices\n" + faceColors + "end_header\n" + body;
}
const std::string kBytes = "property uchar red\nproperty uchar green\nproperty uchar blue\n";

TEST(PlyColors, aFaceHasTheMeanOfItsCorners) {
  const Mesh mesh = coloredOf(ply(kBytes + "property uchar alpha\n", "", "0 0 0 0 100 200 255\n1 0 0 0 100 200 0\n1 1 0 90 100 200 255\n0 1 0 190 100 200 0\n4 0 1 2 3\n3 0 1 2\n"));
  ASSERT_EQ(mesh.colors.size(), 3u);
  const glm::vec4 expected[] = {{70, 100, 200, 0.5}, {70, 100, 200, 0.5}, {30, 100, 200, 2 / 3.0}};
  for (int t = 0; t < 3; ++t) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(mesh.colors[t][c], expected[t][c], 1e-4) << t << ' ' << c;
  }
}

TEST(PlyColors, aFacesOwnColourComesFirstWhereverItStands) {
  const std::string vertices = "0 0 0 9 9 9\n1 0 0 9 9 9\n1 1 0 9 9 9\n0 1 0 9 9 9\n";
  const Mesh mesh = coloredOf(ply(kBytes, kBytes, vertices + "4 0 1 2 3 10 20 30\n3 0 1 2 40 50 60\n"));
  EXPECT_EQ(mesh.colors, (Colors{{10, 20, 30, kNone}, {10, 20, 30, kNone}, {40, 50, 60, kNone}}));
}

TEST(PlyColors, floatsRunFromZeroToOneAndOtherWordsAreKnown) {
  const std::string floats = "property float diffuse_red\nproperty float diffuse_green\nproperty float diffuse_blue\n";
  const Mesh mesh = coloredOf(ply("", floats, "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 1 0.2 7\n3 0 2 3 0 -1 0.4\n"));
  EXPECT_EQ(mesh.colors, (Colors{{255, 51, 255, kNone}, {0, 0, 102, kNone}}));
}

TEST(PlyColors, binaryOnesToo) {
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" + kBytes +
                     "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  for (int i = 0; i < 3; ++i) text += bytesOf(float(i == 1)) + bytesOf(float(i == 2)) + bytesOf(0.0f) + "\x10\x20\x30";
  text += '\x03';
  text += bytesOf(0) + bytesOf(1) + bytesOf(2);
  EXPECT_EQ(coloredOf(text).colors.size(), 1u);
  EXPECT_NEAR(coloredOf(text).colors[0].g, 32, 1e-4);
  EXPECT_TRUE(meshOf(text).colors.empty());
}

TEST(PlyColors, twoChannelsAreNoColour) {
  EXPECT_TRUE(coloredOf(ply("property uchar red\nproperty uchar green\n", "", "0 0 0 1 1\n1 0 0 1 1\n1 1 0 1 1\n0 1 0 1 1\n3 0 1 2\n3 0 2 3\n")).colors.empty());
}

}  // namespace
}  // namespace copeel
