// Reads a file whole into memory. Not mapped: a mapped file that another process cuts short ends the program with SIGBUS, and reading
// costs little more (871,306 triangles, 16 MB: about 5 ms).
#include "core/formats/input_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

namespace copeel {
namespace {

constexpr std::size_t kFirstPipeBytes = 1 << 16;  // a pipe does not tell its size; the buffer doubles from here
constexpr std::size_t kQuotedBytes = 24;          // of a file's own text in a message

// Closes on every way out of the constructor below.
struct Descriptor {
  int value;
  ~Descriptor() {
    if (value >= 0) ::close(value);
  }
};

bool printable(char c) { return static_cast<unsigned char>(c) >= 0x20 && c != 0x7f; }

std::string causeOf(int error) { return std::generic_category().message(error); }

}  // namespace

Source::Source(std::span<const char> bytes, std::string name) : bytes_(bytes), name_(std::move(name)) {
  for (char& c : name_) {
    if (!printable(c)) c = '?';
  }
}

Source Source::withoutByteOrderMark() const {
  const bool marked = std::string_view(data(), size()).starts_with("\xef\xbb\xbf");
  return marked ? Source(bytes_.subspan(3), name_) : *this;
}

std::size_t Source::lineOf(std::size_t place) const {
  std::size_t line = 1;
  for (std::size_t i = 0; i < std::min(place, bytes_.size()); ++i) {
    const bool pair = bytes_[i] == '\r' && i + 1 < bytes_.size() && bytes_[i + 1] == '\n';
    if (bytes_[i] == '\n' || (bytes_[i] == '\r' && !pair)) ++line;
  }
  return line;
}

InputFile::InputFile(const std::string& path) : path_(path) {
  const Source source({}, path);
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.value < 0) source.fail("cannot open: {}", causeOf(errno));
  struct stat status {};
  if (::fstat(file.value, &status) != 0) source.fail("cannot read: {}", causeOf(errno));
  if (S_ISDIR(status.st_mode)) source.fail("is a directory");
  // One byte more than the size lets the end show itself without growing the buffer.
  readAll(file.value, S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) + 1 : kFirstPipeBytes);
}

void InputFile::readAll(int descriptor, std::size_t expectedSize) {
  std::size_t capacity = std::max<std::size_t>(expectedSize, 1);
  bytes_ = std::make_unique_for_overwrite<char[]>(capacity);
  for (;;) {
    if (size_ == capacity) {
      auto larger = std::make_unique_for_overwrite<char[]>(capacity * 2);
      std::memcpy(larger.get(), bytes_.get(), size_);
      bytes_ = std::move(larger);
      capacity *= 2;
    }
    const ssize_t count = ::read(descriptor, bytes_.get() + size_, capacity - size_);
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) source().fail("cannot read: {}", causeOf(errno));
    if (count == 0) return;
    size_ += static_cast<std::size_t>(count);
  }
}

std::string quoted(std::string_view text) {
  std::string result(text.substr(0, kQuotedBytes));
  for (char& c : result) {
    if (!printable(c)) c = '?';
  }
  return "'" + result + (text.size() > kQuotedBytes ? "...'" : "'");
}

}  // namespace copeel
