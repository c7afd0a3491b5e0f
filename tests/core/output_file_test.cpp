// Outputs appear whole or not at all, whatever stops them: no permission, no folder, a full disk, an exception, a signal.
#include "core/output_file.h"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include "core/error.h"
#include "core/image/write_image.h"
#include "tests/temporary_folder.h"

namespace copeel {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string faultOf(const std::string& path) {
  try {
    writeFile(path, "content");
    return "";
  } catch (const Error& error) {
    return error.code() == ExitCode::Machine ? error.what() : "wrong exit code";
  }
}

TEST(OutputFile, appearsAtCommitOnly) {
  const TemporaryFolder folder;
  {
    OutputFile file(folder.file("a"));
    file.write("whole");
    EXPECT_FALSE(std::filesystem::exists(folder.file("a")));
    file.commit();
    EXPECT_EQ(contentOf(folder.file("a")), "whole");
  }
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(OutputFile, leavesTheOldFileWhenGivenUp) {
  const TemporaryFolder folder;
  folder.write("a", "old");
  {
    OutputFile file(folder.file("a"));
    file.write("half");
  }
  EXPECT_EQ(contentOf(folder.file("a")), "old");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(OutputFile, namesOfAnyLengthAndLinksAndModesStay) {
  const TemporaryFolder folder;
  EXPECT_EQ(faultOf(folder.file(std::string(255, 'n'))), "");
  folder.write("real", "old");
  std::filesystem::permissions(folder.file("real"), std::filesystem::perms(0640));
  std::filesystem::create_symlink("real", folder.file("link"));
  EXPECT_EQ(faultOf(folder.file("link")), "");
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link")));
  EXPECT_EQ(contentOf(folder.file("real")), "content");
  EXPECT_EQ(std::filesystem::status(folder.file("real")).permissions(), std::filesystem::perms(0640));
}

TEST(OutputFile, failuresNameTheFileAndTheCause) {
  const TemporaryFolder folder;
  EXPECT_EQ(faultOf(folder.file("no/where")), folder.file("no/where") + ": cannot write: No such file or directory");
  EXPECT_EQ(faultOf(folder.file(".")), folder.file(".") + ": cannot write: Is a directory");
  EXPECT_EQ(faultOf("/dev/full"), "/dev/full: cannot write: No space left on device");
  EXPECT_EQ(faultOf(""), ": cannot write: No such file or directory");
  EXPECT_EQ(faultOf("/dev/null"), "");
  EXPECT_EQ(folder.fileCount(), 0u);
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  std::filesystem::permissions(folder.file("."), std::filesystem::perms(0555));
  EXPECT_EQ(faultOf(folder.file("a")), folder.file("a") + ": cannot write: Permission denied");
}

// Runs `body` in a process of its own, which may be limited or killed; its wait status.
template <class Body>
int statusOfChild(Body body) {
  const pid_t child = ::fork();
  if (child == 0) {
    body();
    ::_exit(0);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

// A limit on the size of files stands for a full disk: write() fails in the middle in the same way.
TEST(OutputFile, aFullDiskLeavesNothing) {
  const TemporaryFolder folder;
  folder.write("image.pfm", "old");
  const int status = statusOfChild([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{1000, 1000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      writePfm(folder.file("image.pfm"), Image<float>(100, 100));
    } catch (const Error& error) {
      ::_exit(static_cast<int>(error.code()));
    }
  });
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_EQ(contentOf(folder.file("image.pfm")), "old");
  EXPECT_EQ(folder.fileCount(), 1u);
}

TEST(OutputFile, aSignalRemovesTheTemporariesAndEndsTheProcess) {
  const TemporaryFolder folder;
  const int status = statusOfChild([&] {
    cleanUpOnSignal();
    OutputFile first(folder.file("a")), second(folder.file("b"));
    first.write("half");
    ::raise(SIGINT);
  });
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGINT);
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(OutputFile, writesToAFifo) {
  const TemporaryFolder folder;
  ASSERT_EQ(::mkfifo(folder.file("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = contentOf(folder.file("pipe")); });
  writeFile(folder.file("pipe"), "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_EQ(folder.fileCount(), 1u);
}

}  // namespace
}  // namespace copeel
