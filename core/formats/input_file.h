// The bytes of an input, and how a reader says what is wrong with them. Readers work on memory, so that a test or a fuzzer needs no file.
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "core/error.h"

namespace copeel {

// Named bytes. A place is an offset into them; it becomes a line number only when a message needs one, so that reading counts nothing.
class Source {
 public:
  Source(std::span<const char> bytes, std::string name);

  const char* data() const { return bytes_.data(); }
  std::size_t size() const { return bytes_.size(); }
  const std::string& name() const { return name_; }
  Source withoutByteOrderMark() const;          // text in UTF-8 may begin with one
  std::size_t lineOf(std::size_t place) const;  // from 1; \n, \r\n and a lone \r end a line

  // Error{Input}: "name:line: cause", "name: byte N: cause", "name: cause".
  template <class... Args>
  [[noreturn]] void failAtLine(std::size_t place, fmt::format_string<Args...> format, Args&&... args) const {
    failInput("{}:{}: {}", name_, lineOf(place), fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  [[noreturn]] void failAtByte(std::size_t place, fmt::format_string<Args...> format, Args&&... args) const {
    failInput("{}: byte {}: {}", name_, place, fmt::format(format, std::forward<Args>(args)...));
  }
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    failInput("{}: {}", name_, fmt::format(format, std::forward<Args>(args)...));
  }

 private:
  std::span<const char> bytes_;
  std::string name_;  // without control characters, so that a message stays one line
};

// A file read whole. Throws Error{Input} when it cannot be opened or read.
class InputFile {
 public:
  explicit InputFile(const std::string& path);
  Source source() const { return Source({bytes_.get(), size_}, path_); }

 private:
  void readAll(int descriptor, std::size_t expectedSize);

  std::string path_;
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

// Text of a file made fit for a message: short, one line, printable.
std::string quoted(std::string_view text);

}  // namespace copeel
