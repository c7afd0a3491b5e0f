#include "apps/command/interrupts.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>

#include "core/error.h"

namespace copeel {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

int signalPipe[2] = {-1, -1};
std::mutex foldersMutex;
std::vector<std::string> folders;   // to be removed at an interrupt

extern "C" void tellThread(int signal) {
  const int savedErrno = errno;
  const char byte = static_cast<char>(signal);
  // The pipe never fills: one signal ends the program.
  [[maybe_unused]] const ssize_t written = write(signalPipe[1], &byte, 1);
  errno = savedErrno;
}

void waitForSignal() {
  char signal = 0;
  while (read(signalPipe[0], &signal, 1) != 1) {
    if (errno != EINTR) return;
  }
  // The lock is kept to the end: no new folder can appear between the clean-up and the death.
  const std::lock_guard lock(foldersMutex);
  for (const std::string& folder : folders) {
    // A writer may put a file into a folder while it is being emptied, but not after it is gone.
    std::error_code error;
    for (int attempt = 0; attempt < 100; ++attempt) {
      std::filesystem::remove_all(folder, error);
      if (!error) break;
    }
  }
  std::signal(signal, SIG_DFL);
  raise(signal);
  pause();   // the signal is on its way to some thread
}

}  // namespace

void installInterrupts() {
  std::signal(SIGPIPE, SIG_IGN);
  // Closed at exec, so that programs we start do not hold it.
  if (pipe2(signalPipe, O_CLOEXEC) != 0) return;
  std::thread(waitForSignal).detach();
  for (const int signal : kSignals) {
    struct sigaction action = {};
    sigaction(signal, nullptr, &action);
    if (action.sa_handler == SIG_IGN) continue;   // nohup, or a background job of a script
    action = {};
    action.sa_handler = tellThread;
    action.sa_flags = SA_RESTART;
    sigaction(signal, &action, nullptr);
  }
}

TemporaryFolder::TemporaryFolder(const std::string& parent) {
  const std::lock_guard lock(foldersMutex);
  std::string name = (std::filesystem::path(parent) / ".copeel-XXXXXX").string();
  if (!mkdtemp(name.data())) failMachine("cannot write into {}: {}", parent, std::strerror(errno));
  path_ = name;
  folders.push_back(path_);
}

TemporaryFolder::~TemporaryFolder() {
  const std::lock_guard lock(foldersMutex);
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
  std::erase(folders, path_);
}

}  // namespace copeel
