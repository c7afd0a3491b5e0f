// What a signal that ends the program takes with it: temporaries that are no outputs yet, and programs that work for this one.
#pragma once

#include <csignal>
#include <string>

#include <sys/types.h>

namespace copeel {

// While it lives, a signal removes the file, or the folder with the files in it, too.
class RemovedOnSignal {
 public:
  explicit RemovedOnSignal(const std::string& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  int slot_;
};

// While it lives, a signal ends the child too. To be gone before the child's number may be another's, so before it is waited for.
class EndedOnSignal {
 public:
  explicit EndedOnSignal(pid_t process);
  ~EndedOnSignal();
  EndedOnSignal(const EndedOnSignal&) = delete;
  EndedOnSignal& operator=(const EndedOnSignal&) = delete;

 private:
  int slot_;
};

// While it lives, signals wait: a child is known to them before its parent ends. The child is to be given the signals that were held back before.
class SignalsWait {
 public:
  SignalsWait();
  ~SignalsWait();
  SignalsWait(const SignalsWait&) = delete;
  SignalsWait& operator=(const SignalsWait&) = delete;
  const sigset_t& before() const { return before_; }

 private:
  sigset_t before_;
};

// For main: SIGINT, SIGTERM and SIGHUP do so and then end the process as they would have.
void cleanUpOnSignal();

}  // namespace copeel
