// Programs as a user starts them, with their wall time and peak memory as the system counts them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <sys/types.h>

namespace copeel::bench {

struct ProcessLimits {
  double seconds = 120;               // then the program is ended
};

struct ProcessRun {
  double wallMs = 0;                  // from before it is started to its end
  std::uint64_t peakBytes = 0;        // largest resident set of the program itself
  int exitCode = -1;                  // 127 where it could not be started, 128 + signal where one ended it
  bool timedOut = false;
  std::string errors;                 // what it wrote to standard error
};

// `command[0]` is looked for in PATH. Standard input is empty, standard output is thrown away.
ProcessRun runProcess(const std::vector<std::string>& command, const ProcessLimits& limits);

bool isInstalled(const std::string& program);

// One X server without a screen of its own, for programs that cannot do without; started before the first clock runs, ended with this.
class XServer {
 public:
  XServer();                          // sets DISPLAY for all that is started after it
  ~XServer();
  XServer(const XServer&) = delete;
  XServer& operator=(const XServer&) = delete;
  bool running() const { return process_ > 0; }

 private:
  pid_t process_ = -1;
};

}  // namespace copeel::bench
