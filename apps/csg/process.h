// Programs run without a shell, several at once, and a folder for their files that goes away again.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <sys/types.h>

#include "core/on_signal.h"

namespace copeel::csg {

struct Command {
  std::vector<std::string> arguments;   // the program first; looked up in PATH when it names no folder
  std::string logPath;                  // both of its outputs go here
  int exitCode = -1;                    // set when it has ended; 128 + signal where one ended it
};

// A program that runs beside this one.
class Process {
 public:
  explicit Process(const Command& command);   // Error{Machine} where it cannot be started
  ~Process();                                 // ends it where it still runs
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  int wait();                                 // gives the exit code, as in Command
  pid_t id() const { return id_; }

 private:
  Process(const Command& command, const SignalsWait& wait);
  pid_t id_;
  std::optional<EndedOnSignal> onSignal_;
  bool ended_ = false;
  int exitCode_ = -1;
};

// Runs all of them, at most `atOnce` at a time, and waits. Throws Error{Machine} where one cannot be started.
void runAll(std::vector<Command>& commands, unsigned atOnce);

std::string systemTemporaryFolder();          // Error{Machine} where TMPDIR names none

class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& parent);   // Error{Machine} where none can be made
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  std::optional<RemovedOnSignal> onSignal_;
};

}  // namespace copeel::csg
