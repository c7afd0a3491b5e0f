#include "apps/command/progress.h"

#include <cstdio>

#include <fmt/format.h>
#include <unistd.h>

namespace copeel {

Progress::Progress(bool wanted) {
  if (wanted && isatty(STDERR_FILENO)) thread_ = std::thread([this] { show(); });
}

Progress::~Progress() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  thread_.join();
}

void Progress::phase(const std::string& name) {
  const std::lock_guard lock(mutex_);
  phase_ = name;
}

void Progress::show() {
  using namespace std::chrono;
  bool shown = false;
  std::unique_lock lock(mutex_);
  // One line a second from the first second on, each over the last; "\033[K" clears what a longer one left.
  while (!wake_.wait_for(lock, seconds(1), [this] { return done_; })) {
    const auto elapsed = duration_cast<seconds>(steady_clock::now() - start_).count();
    fmt::print(stderr, "\rcopeel: {} … {} s\033[K", phase_, elapsed);
    std::fflush(stderr);
    shown = true;
  }
  if (shown) {
    fmt::print(stderr, "\r\033[K");
    std::fflush(stderr);
  }
}

}  // namespace copeel
