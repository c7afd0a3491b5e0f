// Runs the program as a user does, in a folder of its own.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <sys/types.h>

namespace copeel {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kHasSanitizer = true;
#else
inline constexpr bool kHasSanitizer = false;
#endif
// A sanitizer maps terabytes, which count as data.
inline constexpr const char* kPastAnyLimit = "the sanitizer's own memory is past any limit";
inline constexpr const char* kAmpleMemory = kHasSanitizer ? "1000000G" : "2G";

struct Outcome {
  int exitCode = -1;   // -1: ended by a signal
  int signal = 0;
  std::string standardOutput;
  std::string standardError;
};

// A program that has been started; finish() waits for it.
class Program {
 public:
  Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments);
  void send(int signal) const;
  void closeStandardOutput();   // as a reader that has had enough
  Outcome finish();

 private:
  pid_t process_ = -1;
  int output_ = -1;
  int error_ = -1;
};

// A temporary folder per test, with `part.csg` in it, in which the program runs.
class ProgramTest : public ::testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override;
  Outcome run(const std::vector<std::string>& arguments) { return Program(folder_, arguments).finish(); }
  void write(const std::string& name, const std::string& content) const;
  std::vector<std::string> files() const;   // all names in the folder, hidden ones too, sorted

  std::filesystem::path folder_;
};

// The exit code, and exactly one line on standard error, which begins with "copeel: ".
void expectFailure(const Outcome& outcome, int exitCode);

std::string contentOf(const std::filesystem::path& path);

}  // namespace copeel
