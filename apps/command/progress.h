// What the program is doing, on the last line of a terminal, and only when it takes longer than a second.
#pragma once

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace copeel {

class Progress {
 public:
  explicit Progress(bool wanted);   // nothing is shown where standard error is not a terminal
  ~Progress();                      // clears the line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  void phase(const std::string& name);   // "reading part.scad"

 private:
  void show();

  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable wake_;
  std::string phase_;
  bool done_ = false;
  std::thread thread_;   // last: it uses the others
};

}  // namespace copeel
