// Files that are at fault: one line with file, place and cause; never a crash, a hang, or a mesh that has lost something.
#include <unistd.h>

#include <gtest/gtest.h>

#include "mesh_texts.h"
#include "tests/temporary_folder.h"

namespace copeel {
namespace {

const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n";

std::string binaryPly(const std::string& vertexCount, const std::string& body) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex " + vertexCount +
         "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uint int "
         "vertex_indices\nend_header\n" +
         body;
}

TEST(Faults, indexOutOfRangeNamesTheLineAndTheFilesOwnNumber) {
  EXPECT_EQ(faultOf("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 3\n"),
            "m:7: vertex index 3 is out of range: the file has 3 vertices");
  EXPECT_EQ(faultOf("v 0 0 0\nv 1 0 0\nf 1 2 3\n"), "m:3: vertex index 3 is out of range: the file has 2 vertices");
  EXPECT_EQ(faultOf("v 0 0 0\nf 1 1 -2\n"), "m:2: vertex index -2 is out of range: 1 vertices so far");
  EXPECT_EQ(faultOf("v 0 0 0\nf 0 1 1\n"), "m:2: vertex index 0: OBJ counts from 1");
  EXPECT_EQ(faultOf(kPly + "3 0 1 -1\n"), "m:13: vertex index -1 is out of range: the file has 3 vertices");
  EXPECT_EQ(faultOf("OFF 1 1 0\n0 0 0\n2 0 1\n"), "m:3: vertex index 1 is out of range: the file has 1 vertices");
}

TEST(Faults, coordinatesMustBeFinite) {
  for (const std::string bad : {"nan", "-NaN", "inf", "-Infinity", "1e400", "-1e400"}) {
    EXPECT_EQ(faultOf("OFF\n1 0 0\n0 " + bad + " 0\n"), "m:3: a coordinate is not a finite number: '" + bad + "'");
    EXPECT_EQ(faultOf("v 0 0 " + bad + "\n"), "m:1: a coordinate is not a finite number: '" + bad + "'");
  }
  const std::string floats = bytesOf(0.f) + bytesOf(__builtin_nanf("")) + bytesOf(0.f);
  const std::string fault = faultOf(binaryPly("1", floats + bytesOf(std::uint32_t{0})));
  EXPECT_EQ(fault,
            "m: byte " + std::to_string(binaryPly("1", "").size() + 4) + ": a coordinate is not a finite number: nan");
}

TEST(Faults, wordsWhereNumbersShouldBe) {
  EXPECT_EQ(faultOf("OFF\n1 0 0\n0 1,5 0\n"), "m:3: a coordinate should be here, found '1,5'");
  EXPECT_EQ(faultOf("OFF\n1.5 0 0\n"), "m:2: the number of vertices should be here, found '1.5'");
  EXPECT_EQ(faultOf("v 0 0 0x10\n"), "m:1: a coordinate should be here, found '0x10'");
  EXPECT_EQ(faultOf("v 0 0\nv 1 0 0\n"), "m:1: a coordinate should be here, found ''");
  EXPECT_EQ(faultOf("v 0 0 0\nf 1 1 a/b\n"), "m:2: a vertex index should be here, found 'a/b'");
  EXPECT_EQ(faultOf("v 0 0 0\nwhat 1\n"), "m:2: 'what' is no OBJ keyword");
}

TEST(Faults, everyTruncationOfATextIsNoticed) {
  const std::string off = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2";
  for (std::size_t size = 0; size < off.size(); ++size) EXPECT_NE(faultOf(off.substr(0, size)), "") << size;
  const std::string ply = kPly + "3 0 1 2";
  for (std::size_t size = 0; size < ply.size(); ++size) EXPECT_NE(faultOf(ply.substr(0, size)), "") << size;
  const std::string stl =
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid";
  for (std::size_t size = 0; size < stl.size(); ++size) EXPECT_NE(faultOf(stl.substr(0, size)), "") << size;
}

TEST(Faults, everyTruncationOfABinaryFileIsNoticed) {
  std::string body = std::string(36, '\0') + bytesOf(std::uint32_t{3});
  for (const std::int32_t i : {0, 1, 2}) body += bytesOf(i);
  const std::string ply = binaryPly("3", body);
  ASSERT_EQ(faultOf(ply), "");
  for (std::size_t size = 0; size < ply.size(); ++size) EXPECT_NE(faultOf(ply.substr(0, size)), "") << size;
  const std::string stl = std::string(80, ' ') + bytesOf(std::uint32_t{2}) + std::string(100, '\0');
  ASSERT_EQ(faultOf(stl), "");
  for (std::size_t size = 0; size < stl.size(); ++size) EXPECT_NE(faultOf(stl.substr(0, size)), "") << size;
}

TEST(Faults, whatTheCountsLeaveOverIsNotDropped) {
  EXPECT_EQ(faultOf("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n"),
            "m:7: the file should end here by its counts, found '3'");
  EXPECT_EQ(faultOf(kPly + "3 0 1 2\n3 2 1 0\n"), "m:14: the file should end here by its counts, found '3'");
  EXPECT_NE(faultOf("solid\nendsolid\nrubbish\n"), "");
}

// A zero byte may be the first of a coordinate that the counts forgot.
TEST(Faults, zeroBytesAfterABinaryFileAreNotBlanks) {
  const std::string empty = binaryPly("1", std::string(12, '\0') + bytesOf(std::uint32_t{0}));
  EXPECT_EQ(faultOf(empty + "\r\n \n"), "");
  EXPECT_NE(faultOf(empty + std::string(12, '\0')), "");
}

// Each element may claim what the file could hold, all of them together no more.
TEST(Faults, manyElementsClaimNoMoreMemoryThanOne) {
  std::string ply = "ply\nformat binary_little_endian 1.0\n";
  for (int i = 0; i < 30000; ++i) ply += "element face 1000000000000\nproperty list uchar int vertex_indices\n";
  EXPECT_NE(faultOf(ply + "end_header\n" + std::string(10, '\0')).find("truncated"), std::string::npos);
}

TEST(Faults, countsOfFourBillionNeitherAllocateNorHang) {
  for (const std::string count : {"4000000000", "4294967296", "9223372036854775807", "99999999999999999999"}) {
    EXPECT_NE(faultOf("OFF\n" + count + " 1 0\n0 0 0\n"), "");
    EXPECT_NE(faultOf("OFF\n1 " + count + " 0\n0 0 0\n"), "");
    EXPECT_NE(faultOf("OFF\n1 1 0\n0 0 0\n" + count + " 0 0 0\n"), "");
    EXPECT_NE(faultOf(binaryPly(count, std::string(40, '\0'))), "");
    EXPECT_NE(faultOf("v 0 0 0\nf 1 1 " + count + "\n"), "");
  }
  EXPECT_NE(faultOf(binaryPly("0", bytesOf(std::uint32_t{0xffffffff}) + std::string(40, '\0'))), "");
  EXPECT_NE(faultOf(std::string(80, '\0') + bytesOf(std::uint32_t{0xffffffff}) + std::string(50, '\0')), "");
  // Elements without properties take no bytes; counting them would be all there is to do.
  EXPECT_EQ(faultOf("ply\nformat ascii 1.0\nelement nothing 9223372036854775807\nend_header\n"), "");
}

TEST(Faults, otherKindsOfFiles) {
  EXPECT_EQ(faultOf(""), "m: the file is empty");
  EXPECT_NE(faultOf(" \n\t\n"), "");
  EXPECT_NE(faultOf("\x89PNG\r\n\x1a\n"), "");
  EXPECT_NE(faultOf(std::string(1000, '\0')), "");
  EXPECT_NE(faultOf("<html></html>"), "");
  EXPECT_EQ(faultOf("4OFF\n1 0 0\n0 0 0 1\n"), "m:1: vertices of other than three dimensions ('4OFF')");
  EXPECT_EQ(faultOf("OFF BINARY\n"), "m:1: binary OFF is not read");
  EXPECT_EQ(faultOf("v 0 0 0\nsurf 0 1 0 1 1\n"), "m:2: curved surfaces and calls are not read (surf)");
  EXPECT_NE(faultOf("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nend_header\n0\n"), "");
  EXPECT_NE(faultOf("ply\nformat ascii 1.0\nelement face 1\nproperty int x\nend_header\n0\n"), "");
  EXPECT_NE(faultOf("ply\nformat ascii 1.0\nelement face 1\nproperty list uchar float vertex_indices\nend_header\n0\n"),
            "");
}

std::string faultOfFile(const std::string& path) {
  try {
    readMesh(path);
    return "";
  } catch (const Error& error) {
    return error.code() == ExitCode::Input ? error.what() : "wrong exit code";
  }
}

TEST(Files, cannotBeOpened) {
  const TemporaryFolder folder;
  EXPECT_EQ(faultOfFile(folder.file("none.off")), folder.file("none.off") + ": cannot open: No such file or directory");
  EXPECT_EQ(faultOfFile(folder.file(".")), folder.file(".") + ": is a directory");
  EXPECT_EQ(faultOfFile(""), ": cannot open: No such file or directory");
  const std::string locked = folder.write("locked.off", "OFF\n0 0 0\n");
  std::filesystem::permissions(locked, std::filesystem::perms::none);
  if (::geteuid() == 0) GTEST_SKIP() << "root may read everything";
  EXPECT_EQ(faultOfFile(locked), locked + ": cannot open: Permission denied");
}

TEST(Files, namesAreJustNames) {
  const TemporaryFolder folder;
  for (const char* name : {"with spaces.off", "-leading",
                           "gr\xc3\xbc\xc3\x9f"
                           "e \xe6\xa8\xa1.stl",
                           "wrong.stl", "noextension", "new\nline"}) {
    EXPECT_EQ(faultOfFile(folder.write(name, "OFF\n0 0 0\n")), "") << name;
    const std::string fault = faultOfFile(folder.write(name, "OFF\nx 0 0\n"));
    EXPECT_NE(fault, "");
    EXPECT_EQ(fault.find('\n'), std::string::npos) << "a message is one line";
  }
}

}  // namespace
}  // namespace copeel
