// Atomic output by a temporary and rename(2). The names of open temporaries are also kept in a fixed array that a signal handler may read:
// nothing there allocates or locks. No fsync: the promise is against failures of the program, not of the power supply.
#include "core/output_file.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace copeel {
namespace {

// One open temporary. The path is written while the slot is Claimed, so a handler that sees Active sees all of it.
struct SignalSlot {
  enum State { Free, Claimed, Active };
  std::atomic<int> state{Free};
  std::array<char, PATH_MAX> path{};
};
static_assert(std::atomic<int>::is_always_lock_free, "the signal handler reads the state");

constexpr int kSignalSlotCount = 16;  // outputs open at once; further ones are only not removed on a signal
std::array<SignalSlot, kSignalSlotCount> signalSlots;

int claimSignalSlot(const std::string& path) {
  if (path.size() >= PATH_MAX) return -1;
  for (int i = 0; i < kSignalSlotCount; ++i) {
    int expected = SignalSlot::Free;
    if (!signalSlots[i].state.compare_exchange_strong(expected, SignalSlot::Claimed)) continue;
    std::memcpy(signalSlots[i].path.data(), path.c_str(), path.size() + 1);
    signalSlots[i].state = SignalSlot::Active;
    return i;
  }
  return -1;
}

void releaseSignalSlot(int slot) {
  if (slot >= 0) signalSlots[slot].state = SignalSlot::Free;
}

// The system call itself, since opendir() allocates. Removing moves what follows, so a folder is read until nothing of it can be removed.
void removeFolderOfFiles(const char* path) {
  const int folder = ::open(path, O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  if (folder < 0) return;
  alignas(dirent64) static char entries[4096];
  for (bool removed = true; removed;) {
    removed = false;
    ::lseek(folder, 0, SEEK_SET);
    const long size = ::syscall(SYS_getdents64, folder, entries, sizeof entries);
    for (long at = 0; at < size; at += reinterpret_cast<const dirent64*>(entries + at)->d_reclen) {
      removed |= ::unlinkat(folder, reinterpret_cast<const dirent64*>(entries + at)->d_name, 0) == 0;
    }
  }
  ::close(folder);
  ::rmdir(path);
}

extern "C" void removeTemporariesAndDie(int signal) {
  for (SignalSlot& slot : signalSlots) {
    if (slot.state == SignalSlot::Active && ::unlink(slot.path.data()) != 0) removeFolderOfFiles(slot.path.data());
  }
  // SA_RESETHAND has restored the default action, so this ends the process with the status a shell expects.
  ::raise(signal);
}

// The file behind symbolic links, so that renaming replaces the file and not the link.
std::string resolved(const std::string& path) {
  char* real = ::realpath(path.c_str(), nullptr);
  if (!real) return path;
  std::string result = real;
  std::free(real);
  return result;
}

std::string folderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(resolved(path)) {
  if (path.empty()) fail(ENOENT);
  // Through the open descriptor: where standard output is a file, that file may be a log that others write to, and is no target to replace.
  if (path == "/dev/stdout" || path == "/dev/stderr") {
    descriptor_ = ::fcntl(path == "/dev/stdout" ? STDOUT_FILENO : STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  // rename() would replace a read-only file; who protected it did not mean that.
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(errno);
  openTemporary();
  if (exists) (void)!::fchmod(descriptor_, status.st_mode & 07777);
}

OutputFile::~OutputFile() { discard(); }

// The name is short and of its own, since the target's may already be as long as the file system allows.
void OutputFile::openTemporary() {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 1000; ++attempt) {
    std::string name = fmt::format("{}.copeel-{}-{}.tmp", folderOf(target_), ::getpid(), counter++);
    signalSlot_ = claimSignalSlot(name);
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const int error = errno;
    if (descriptor_ >= 0) {
      temporary_ = std::move(name);
      return;
    }
    releaseSignalSlot(std::exchange(signalSlot_, -1));
    if (error != EEXIST) fail(error);
  }
  fail(EEXIST);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  // Some file systems report a full disk only here.
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  releaseSignalSlot(std::exchange(signalSlot_, -1));
}

void OutputFile::fail(int error) {
  discard();
  failMachine("{}: cannot write: {}", path_, std::generic_category().message(error));
}

void OutputFile::discard() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  releaseSignalSlot(std::exchange(signalSlot_, -1));
}

void writeFile(const std::string& path, std::string_view content) {
  OutputFile file(path);
  file.write(content);
  file.commit();
}

RemovedOnSignal::RemovedOnSignal(const std::string& path) : signalSlot_(claimSignalSlot(path)) {}

RemovedOnSignal::~RemovedOnSignal() { releaseSignalSlot(signalSlot_); }

void removeTemporariesOnSignal() {
  struct sigaction action {};
  action.sa_handler = removeTemporariesAndDie;
  action.sa_flags = SA_RESETHAND | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // A signal that the parent chose to ignore (nohup) stays ignored.
    struct sigaction previous {};
    if (::sigaction(signal, nullptr, &previous) == 0 && previous.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace copeel
