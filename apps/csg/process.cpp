#include "apps/csg/process.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <filesystem>

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

extern char** environ;

namespace copeel::csg {
namespace {

pid_t start(const Command& command, const sigset_t& signals) {
  std::vector<char*> arguments;
  for (const std::string& argument : command.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, command.logPath.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&actions, STDOUT_FILENO, STDERR_FILENO);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setsigmask(&attributes, &signals);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK);
  pid_t process = 0;
  const int status = posix_spawnp(&process, arguments.front(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (status != 0) failMachine("{}: cannot be run: {}", command.arguments.front(), std::strerror(status));
  return process;
}

int codeOf(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + (WIFSIGNALED(status) ? WTERMSIG(status) : 0); }

}  // namespace

Process::Process(const Command& command) : Process(command, SignalsWait()) {}

Process::Process(const Command& command, const SignalsWait& wait) : id_(start(command, wait.before())), onSignal_(id_) {}

Process::~Process() {
  if (!ended_) kill(id_, SIGKILL);
  wait();
}

// Waits for this one alone; other children of the program are none of our business.
int Process::wait() {
  int status = 0;
  if (!ended_) {
    // It stays a zombie under its number until the second call.
    siginfo_t info{};
    while (waitid(P_PID, static_cast<id_t>(id_), &info, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    onSignal_.reset();
    while (waitpid(id_, &status, 0) < 0 && errno == EINTR) {
    }
    exitCode_ = codeOf(status);
    ended_ = true;
  }
  return exitCode_;
}

void runAll(std::vector<Command>& commands, unsigned atOnce) {
  std::deque<Process> running;
  std::size_t ended = 0;
  const auto waitForOldest = [&] {
    commands[ended++].exitCode = running.front().wait();
    running.pop_front();
  };
  for (const Command& command : commands) {
    if (running.size() >= std::max(atOnce, 1u)) waitForOldest();
    running.emplace_back(command);
  }
  while (!running.empty()) waitForOldest();
}

std::string systemTemporaryFolder() {
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::temp_directory_path(error);
  const char* named = std::getenv("TMPDIR");
  if (error) failMachine("TMPDIR: {}: no folder for temporary files: {}", named ? named : "/tmp", error.message());
  return folder.string();
}

TemporaryFolder::TemporaryFolder(const std::string& parent) {
  path_ = (std::filesystem::path(parent) / "copeel.XXXXXX").string();
  if (!mkdtemp(path_.data())) failMachine("{}: no temporary folder can be made: {}", parent, std::strerror(errno));
  onSignal_.emplace(path_);
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

}  // namespace copeel::csg
