// The name is a link to the pipe's end among our own descriptors. A FIFO would be simpler; but opening one waits for a reader, for ever
// where we were killed meanwhile, and a link to a process that is no more leads nowhere.
#include "apps/csg/named_pipe.h"

#include <cerrno>
#include <system_error>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "core/error.h"

namespace copeel::csg {
namespace {

std::string lastError() { return std::generic_category().message(errno); }

struct Descriptor {
  int number;
  ~Descriptor() { close(number); }
};

// Takes what is there; false at the end of it.
bool take(int descriptor, std::string& text) {
  constexpr std::size_t kPipeBytes = std::size_t{1} << 16;   // as much as a pipe holds
  const std::size_t size = text.size();
  text.resize(size + kPipeBytes);
  const ssize_t count = ::read(descriptor, text.data() + size, kPipeBytes);
  text.resize(size + static_cast<std::size_t>(count > 0 ? count : 0));
  return count > 0 || (count < 0 && errno == EINTR);
}

}  // namespace

NamedPipe::NamedPipe(const std::string& name) {
  const bool made = pipe2(ends_, O_CLOEXEC) == 0 && symlink(fmt::format("/proc/{}/fd/{}", getpid(), ends_[1]).c_str(), name.c_str()) == 0;
  if (!made) failMachine("{}: no pipe can be made: {}", name, lastError());
}

NamedPipe::~NamedPipe() {
  closeWriter();
  close(ends_[0]);
}

void NamedPipe::closeWriter() {
  if (ends_[1] >= 0) close(ends_[1]);
  ends_[1] = -1;
}

std::optional<std::string> NamedPipe::read(const Process& writer) {
  // Wait until the writer has opened the pipe and written to it, or has ended.
  const Descriptor process{static_cast<int>(syscall(SYS_pidfd_open, writer.id(), 0))};   // glibc 2.36 declares it for C alone
  if (process.number < 0) failMachine("a process cannot be watched: {}", lastError());
  pollfd watched[] = {{ends_[0], POLLIN, 0}, {process.number, POLLIN, 0}};
  while (poll(watched, 2, -1) < 0) {
    if (errno != EINTR) failMachine("poll: {}", lastError());
  }
  // From now on the end of the text is seen, as nobody else holds the writing end.
  closeWriter();
  std::string text;
  while (take(ends_[0], text)) {
  }
  return text.empty() ? std::nullopt : std::optional(std::move(text));
}

}  // namespace copeel::csg
