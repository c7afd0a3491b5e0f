// Ctrl-C and kill leave nothing half-written: what is registered here is removed before the program dies of the signal.
// The handler only writes a byte to a pipe; a thread of its own does the removing, where every function is allowed.
#pragma once

#include <string>

namespace copeel {

// Once, at the start of main. SIGINT, SIGTERM and SIGHUP end the program as by default, after the clean-up; SIGPIPE is ignored, so
// that a closed pipe becomes an error of the write.
void installInterrupts();

// A folder that exists only while this object does, whatever ends the program (but SIGKILL).
class TemporaryFolder {
 public:
  explicit TemporaryFolder(const std::string& parent);   // throws Error{Machine}
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace copeel
