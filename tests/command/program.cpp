#include "tests/command/program.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <fstream>
#include <iterator>
#include <thread>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

namespace copeel {
namespace {

constexpr const char* kPart = "difference() {\n  cube(size = [40, 40, 20], center = true);\n  cube(size = [20, 20, 20], center = true);\n}\n";

std::string readAll(int descriptor) {
  std::string text;
  std::array<char, 4096> block{};
  for (;;) {
    const ssize_t count = ::read(descriptor, block.data(), block.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
    text.append(block.data(), static_cast<std::size_t>(count));
  }
  ::close(descriptor);
  return text;
}

}  // namespace

Program::Program(const std::filesystem::path& folder, const std::vector<std::string>& arguments) {
  std::vector<std::string> words{COPEEL_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  int output[2], error[2];
  if (::pipe2(output, O_CLOEXEC) != 0 || ::pipe2(error, O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  process_ = ::fork();
  if (process_ == 0) {
    ::dup2(output[1], STDOUT_FILENO);
    ::dup2(error[1], STDERR_FILENO);
    if (::chdir(folder.c_str()) == 0) ::execv(pointers[0], pointers.data());
    ::_exit(127);
  }
  ::close(output[1]);
  ::close(error[1]);
  output_ = output[0];
  error_ = error[0];
}

void Program::send(int signal) const { ::kill(process_, signal); }

void Program::closeStandardOutput() {
  ::close(output_);
  output_ = -1;
}

Outcome Program::finish() {
  Outcome outcome;
  // Both at once: a program that fills one pipe while we wait at the other would wait for ever.
  std::thread errorReader([&] { outcome.standardError = readAll(error_); });
  if (output_ >= 0) outcome.standardOutput = readAll(output_);
  errorReader.join();
  int status = 0;
  while (::waitpid(process_, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status)) outcome.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
  return outcome;
}

void ProgramTest::SetUp() {
  std::string name = (std::filesystem::temp_directory_path() / "copeel-command-XXXXXX").string();
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  folder_ = name;
  write("part.csg", kPart);
}

void ProgramTest::TearDown() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void ProgramTest::write(const std::string& name, const std::string& content) const { std::ofstream(folder_ / name, std::ios::binary) << content; }

std::vector<std::string> ProgramTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

void expectFailure(const Outcome& outcome, int exitCode) {
  EXPECT_EQ(outcome.exitCode, exitCode) << "signal " << outcome.signal << ": " << outcome.standardError;
  EXPECT_TRUE(outcome.standardError.starts_with("copeel: ")) << outcome.standardError;
  EXPECT_EQ(std::count(outcome.standardError.begin(), outcome.standardError.end(), '\n'), 1) << outcome.standardError;
}

std::string contentOf(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace copeel
