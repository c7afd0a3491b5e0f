// Atomic output by a temporary and rename(2). No fsync: the promise is against failures of the program, not of the power supply.
#include "core/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "core/error.h"

namespace copeel {
namespace {

// The file behind symbolic links, so that renaming replaces the file and not the link.
std::string resolved(const std::string& path) {
  char* real = ::realpath(path.c_str(), nullptr);
  if (!real) return path;
  std::string result = real;
  std::free(real);
  return result;
}

std::string folderOf(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path), target_(resolved(path)) {
  if (path.empty()) fail(ENOENT);
  // Through the open descriptor: where standard output is a file, that file may be a log that others write to, and is no target to replace.
  if (path == "/dev/stdout" || path == "/dev/stderr") {
    descriptor_ = ::fcntl(path == "/dev/stdout" ? STDOUT_FILENO : STDERR_FILENO, F_DUPFD_CLOEXEC, 0);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  struct stat status {};
  const bool exists = ::stat(target_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  // rename() would replace a read-only file; who protected it did not mean that.
  if (exists && ::access(target_.c_str(), W_OK) != 0) fail(errno);
  openTemporary();
  if (exists) (void)!::fchmod(descriptor_, status.st_mode & 07777);
}

OutputFile::~OutputFile() { discard(); }

// The name is short and of its own, since the target's may already be as long as the file system allows.
void OutputFile::openTemporary() {
  static std::atomic<unsigned> counter{0};
  for (int attempt = 0; attempt < 1000; ++attempt) {
    std::string name = fmt::format("{}.copeel-{}-{}.tmp", folderOf(target_), ::getpid(), counter++);
    onSignal_.emplace(name);
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const int error = errno;
    if (descriptor_ >= 0) {
      temporary_ = std::move(name);
      return;
    }
    onSignal_.reset();
    if (error != EEXIST) fail(error);
  }
  fail(EEXIST);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) fail(written < 0 ? errno : EIO);
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  // Some file systems report a full disk only here.
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  onSignal_.reset();
}

void OutputFile::fail(int error) {
  discard();
  failMachine("{}: cannot write: {}", path_, std::generic_category().message(error));
}

void OutputFile::discard() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
  temporary_.clear();
  onSignal_.reset();
}

void writeFile(const std::string& path, std::string_view content) {
  OutputFile file(path);
  file.write(content);
  file.commit();
}

}  // namespace copeel
