// The names of open temporaries and the numbers of children are kept in fixed arrays that a signal handler may read: nothing there allocates
// or locks.
#include "core/on_signal.h"

#include <dirent.h>
#include <fcntl.h>
#include <sched.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>

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

constexpr int kChildCount = 64;   // programs at once; further ones only outlive a signal
std::array<std::atomic<pid_t>, kChildCount> children{};
static_assert(std::atomic<pid_t>::is_always_lock_free, "the signal handler reads the children");

constexpr int kSignals[] = {SIGINT, SIGTERM, SIGHUP};
std::atomic<int> waiting{0};      // SignalsWait that live

extern "C" void cleanUpAndDie(int signal) {
  // Another thread's: in its own, signals are held back.
  while (waiting > 0) ::sched_yield();
  // Children first: they may still write into a folder that goes.
  for (const std::atomic<pid_t>& child : children) {
    if (const pid_t process = child; process > 0) ::kill(process, SIGKILL);
  }
  for (SignalSlot& slot : signalSlots) {
    if (slot.state == SignalSlot::Active && ::unlink(slot.path.data()) != 0) removeFolderOfFiles(slot.path.data());
  }
  // SA_RESETHAND has restored the default action, so this ends the process with the status a shell expects.
  ::raise(signal);
}

int claimChild(pid_t process) {
  for (int i = 0; i < kChildCount; ++i) {
    pid_t none = 0;
    if (children[i].compare_exchange_strong(none, process)) return i;
  }
  return -1;
}

}  // namespace

RemovedOnSignal::RemovedOnSignal(const std::string& path) : slot_(claimSignalSlot(path)) {}

RemovedOnSignal::~RemovedOnSignal() { releaseSignalSlot(slot_); }

EndedOnSignal::EndedOnSignal(pid_t process) : slot_(claimChild(process)) {}

EndedOnSignal::~EndedOnSignal() {
  if (slot_ >= 0) children[slot_] = 0;
}

SignalsWait::SignalsWait() {
  sigset_t ours;
  sigemptyset(&ours);
  for (const int signal : kSignals) sigaddset(&ours, signal);
  ::pthread_sigmask(SIG_BLOCK, &ours, &before_);
  ++waiting;
}

SignalsWait::~SignalsWait() {
  --waiting;
  ::pthread_sigmask(SIG_SETMASK, &before_, nullptr);
}

void cleanUpOnSignal() {
  struct sigaction action {};
  action.sa_handler = cleanUpAndDie;
  action.sa_flags = SA_RESETHAND | SA_NODEFER;
  sigemptyset(&action.sa_mask);
  for (const int signal : kSignals) {
    // A signal that the parent chose to ignore (nohup) stays ignored.
    struct sigaction previous {};
    if (::sigaction(signal, nullptr, &previous) == 0 && previous.sa_handler == SIG_IGN) continue;
    ::sigaction(signal, &action, nullptr);
  }
}

}  // namespace copeel
