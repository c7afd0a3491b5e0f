// The one exception type of the project: the environment or the input is at fault, never a bug
// (a bug is a failed CHECK). It is caught once, in main, printed as one line, and sets the exit code.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace copeel {

// The exit codes of the command line; scripts depend on them.
enum class ExitCode { Done = 0, Input = 1, Usage = 2, Machine = 3 };

class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

// The message is one line: file, place (line or byte) and cause, in that order.
template <class... Args>
[[noreturn]] void failInput(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(ExitCode::Input, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
[[noreturn]] void failUsage(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(ExitCode::Usage, fmt::format(format, std::forward<Args>(args)...));
}

template <class... Args>
[[noreturn]] void failMachine(fmt::format_string<Args...> format, Args&&... args) {
  throw Error(ExitCode::Machine, fmt::format(format, std::forward<Args>(args)...));
}

// Aborts with the values of a broken invariant. Used for bugs only.
[[noreturn]] void checkFailed(const char* file, int line, const char* condition, const std::string& values);

#define COPEEL_CHECK(condition, ...) \
  ((condition) ? (void)0 : ::copeel::checkFailed(__FILE__, __LINE__, #condition, fmt::format("" __VA_ARGS__)))

}  // namespace copeel
