#include "apps/command/outputs.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <system_error>

#include <fcntl.h>
#include <unistd.h>

#include "core/error.h"

namespace copeel {
namespace {

namespace fs = std::filesystem;

bool isStandardOutput(const std::string& path) { return path == "-"; }

// A device or pipe: something that exists and is neither a plain file nor to be made one.
bool isStream(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return isStandardOutput(path) || (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status));
}

// Where the file really lies: a symbolic link keeps pointing to its target, which is what gets replaced.
fs::path placeOf(const std::string& path) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(path, error);
  return error ? fs::absolute(path) : place;
}

bool sameFile(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return placeOf(a) == placeOf(b) || fs::equivalent(a, b, ignored);
}

void checkPlace(const std::string& path) {
  if (isStream(path)) return;
  const fs::path place = placeOf(path);
  if (fs::is_directory(place)) failMachine("cannot write {}: it is a directory", path);
  const fs::path folder = place.parent_path();
  if (!fs::is_directory(folder)) failMachine("cannot write {}: no directory {}", path, folder.string());
  if (access(folder.c_str(), W_OK) != 0) failMachine("cannot write {}: {}", path, std::strerror(errno));
}

// The message of a writer names the staged file; the user knows the output by its own name.
[[noreturn]] void failNaming(const Error& error, const std::string& staged, const std::string& path) {
  std::string message = error.what();
  for (auto at = message.find(staged); at != std::string::npos; at = message.find(staged, at + path.size())) {
    message.replace(at, staged.size(), path);
  }
  throw Error(error.code(), message);
}

void copyInto(const std::string& staged, const std::string& path) {
  const int target = isStandardOutput(path) ? dup(STDOUT_FILENO) : open(path.c_str(), O_WRONLY | O_CLOEXEC);
  if (target < 0) failMachine("cannot write {}: {}", path, std::strerror(errno));
  std::ifstream source(staged, std::ios::binary);
  char block[65536];
  bool good = true;
  while (good && (source.read(block, sizeof block), source.gcount() > 0)) {
    const char* from = block;
    for (std::streamsize left = source.gcount(); good && left > 0;) {
      const ssize_t written = write(target, from, static_cast<std::size_t>(left));
      if (written < 0 && errno == EINTR) continue;
      good = written >= 0;
      from += written;
      left -= written;
    }
  }
  const int cause = errno;
  // A full disk may be told only now.
  if (close(target) != 0 && good) failMachine("cannot write {}: {}", path, std::strerror(errno));
  if (!good) failMachine("cannot write {}: {}", path, std::strerror(cause));
}

void moveTo(const std::string& staged, const std::string& path) {
  std::error_code error;
  fs::rename(staged, placeOf(path), error);
  if (error) failMachine("cannot write {}: {}", path, error.message());
}

}  // namespace

void Outputs::add(const std::string& option, const std::string& path, std::function<void(const std::string&)> write) {
  if (!path.empty()) outputs_.push_back({option, path, std::move(write)});
}

void Outputs::check(const std::vector<std::string>& inputs) const {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (isStream(outputs_[i].path) && outputs_[i].path != "-") continue;
    for (std::size_t j = i + 1; j < outputs_.size(); ++j) {
      if (sameFile(outputs_[i].path, outputs_[j].path)) {
        failUsage("{} and {} name the same file, {}", outputs_[i].option, outputs_[j].option, outputs_[j].path);
      }
    }
    for (const std::string& input : inputs) {
      if (sameFile(outputs_[i].path, input)) failUsage("{} would overwrite the input {}", outputs_[i].option, input);
    }
  }
  for (const Output& output : outputs_) checkPlace(output.path);
}

void Outputs::commit() const {
  // One temporary folder for each folder written to: a rename stays within a file system.
  std::map<fs::path, std::unique_ptr<TemporaryFolder>> folders;
  std::vector<std::string> staged;
  for (const Output& output : outputs_) {
    const fs::path parent = isStream(output.path) ? fs::temp_directory_path() : placeOf(output.path).parent_path();
    auto& folder = folders[parent];
    if (!folder) folder = std::make_unique<TemporaryFolder>(parent.string());
    staged.push_back((fs::path(folder->path()) / std::to_string(staged.size())).string());
    try {
      output.write(staged.back());
    } catch (const Error& error) {
      failNaming(error, staged.back(), output.path);
    }
  }
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (isStream(outputs_[i].path)) {
      copyInto(staged[i], outputs_[i].path);
    } else {
      moveTo(staged[i], outputs_[i].path);
    }
  }
}

void writeText(const std::string& path, const std::string& text) {
  std::FILE* file = std::fopen(path.c_str(), "wbe");
  if (!file) failMachine("cannot write {}: {}", path, std::strerror(errno));
  const bool written = std::fwrite(text.data(), 1, text.size(), file) == text.size();
  const int cause = errno;
  const bool closed = std::fclose(file) == 0;
  if (!written || !closed) failMachine("cannot write {}: {}", path, std::strerror(written ? errno : cause));
}

}  // namespace copeel
