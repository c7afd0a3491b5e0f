#include "bench/process.h"

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <sstream>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/error.h"

extern char** environ;

namespace copeel::bench {
namespace {

using Clock = std::chrono::steady_clock;

double secondsSince(Clock::time_point start) { return std::chrono::duration<double>(Clock::now() - start).count(); }

struct Pipe {
  int ends[2];
  Pipe() {
    if (pipe2(ends, O_CLOEXEC) != 0) failMachine("pipe: {}", std::generic_category().message(errno));
  }
  ~Pipe() {
    close(ends[0]);
    closeWriter();
  }
  void closeWriter() {
    if (ends[1] >= 0) close(ends[1]);
    ends[1] = -1;
  }
};

// The process, or -1 where there is no such program. `fd` of the child becomes the pipe's writer.
pid_t start(const std::vector<std::string>& command, const Pipe& pipe, int fd) {
  std::vector<char*> arguments;
  for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (int out : {STDOUT_FILENO, STDERR_FILENO}) posix_spawn_file_actions_addopen(&actions, out, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, pipe.ends[1], fd);
  pid_t process = -1;
  const int failed = posix_spawnp(&process, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return failed ? -1 : process;
}

void end(pid_t process) {
  kill(process, SIGTERM);
  waitpid(process, nullptr, 0);
}

// Everything up to the end of the stream or the time limit; false at the limit.
bool readAll(int fd, double seconds, std::string& text) {
  const auto begin = Clock::now();
  char buffer[4096];
  for (;;) {
    const double left = seconds - secondsSince(begin);
    pollfd ready{fd, POLLIN, 0};
    if (left <= 0 || poll(&ready, 1, static_cast<int>(left * 1000) + 1) == 0) return false;
    const ssize_t count = read(fd, buffer, sizeof buffer);
    if (count <= 0) return true;
    text.append(buffer, static_cast<std::size_t>(count));
  }
}

}  // namespace

ProcessRun runProcess(const std::vector<std::string>& command, const ProcessLimits& limits) {
  ProcessRun run;
  Pipe pipe;
  const auto begin = Clock::now();
  const pid_t process = start(command, pipe, STDERR_FILENO);
  pipe.closeWriter();
  if (process < 0) {
    run.exitCode = 127;
    return run;
  }
  // The end of standard error is the end of the program, or close before it.
  run.timedOut = !readAll(pipe.ends[0], limits.seconds, run.errors);
  if (run.timedOut) kill(process, SIGKILL);
  int status = 0;
  rusage usage{};
  wait4(process, &status, 0, &usage);
  run.wallMs = secondsSince(begin) * 1000;
  run.peakBytes = static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;   // Linux counts in KiB
  run.exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return run;
}

bool isInstalled(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  }
  return false;
}

XServer::XServer() {
  // The server chooses a free display and writes its number once it is ready.
  constexpr int kNumberFd = 3;
  constexpr double kStartSeconds = 20;
  Pipe pipe;
  process_ = start({"Xvfb", "-displayfd", std::to_string(kNumberFd), "-noreset", "-screen", "0", "1280x1024x24"}, pipe, kNumberFd);
  pipe.closeWriter();
  if (process_ < 0) return;
  // To the end of the stream: the line comes in two pieces, and a server that cannot write the second one ends.
  std::string number;
  readAll(pipe.ends[0], kStartSeconds, number);
  if (number.empty()) {
    end(process_);
    process_ = -1;
    return;
  }
  setenv("DISPLAY", fmt::format(":{}", std::atoi(number.c_str())).c_str(), 1);
}

XServer::~XServer() {
  if (process_ > 0) end(process_);
}

}  // namespace copeel::bench
