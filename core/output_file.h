// A file that appears whole or not at all: bytes go to a temporary beside the target, which takes the target's name at commit().
// Devices and pipes (/dev/null, a fifo) have no name to take and are written directly. All failures are Error{Machine}: "file: cause".
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/on_signal.h"

namespace copeel {

class OutputFile {
 public:
  explicit OutputFile(const std::string& path);  // opens; an existing target stays as it is until commit()
  ~OutputFile();                                 // without commit(), removes the temporary
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void write(std::string_view text) { write(std::as_bytes(std::span(text))); }
  void commit();

 private:
  void openTemporary();
  [[noreturn]] void fail(int error);
  void discard();

  std::string path_;       // as the caller named it, for messages
  std::string target_;     // with symbolic links resolved
  std::string temporary_;  // empty when the target is written directly
  std::optional<RemovedOnSignal> onSignal_;
  int descriptor_ = -1;
};

// The whole of a small output in one call.
void writeFile(const std::string& path, std::string_view content);

}  // namespace copeel
