#include "apps/command/outputs.h"

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

#include <unistd.h>

#include "core/error.h"

namespace copeel {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardOutput = "/dev/stdout";

// Where the file really lies, or would lie: links followed as far as they exist.
fs::path placeOf(const std::string& path) {
  std::error_code error;
  const fs::path place = fs::weakly_canonical(fs::absolute(path), error);
  return error ? fs::absolute(path) : place;
}

bool sameFile(const std::string& a, const std::string& b) {
  std::error_code ignored;
  return placeOf(a) == placeOf(b) || fs::equivalent(a, b, ignored);
}

void checkPlace(const std::string& path) {
  if (isStream(path)) return;
  const fs::path place = placeOf(path);
  std::error_code ignored;
  if (fs::is_directory(place, ignored)) failMachine("{}: cannot write: is a directory", path);
  const fs::path folder = place.parent_path();
  if (!fs::is_directory(folder, ignored)) failMachine("{}: cannot write: no directory {}", path, folder.string());
  if (access(folder.c_str(), W_OK) != 0) failMachine("{}: cannot write: {}", path, std::generic_category().message(errno));
}

}  // namespace

bool isStream(const std::string& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  return path == "-" || path == kStandardOutput || (fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status));
}

void Outputs::add(const std::string& option, const std::string& path, std::function<void(const std::string&)> write) {
  if (!path.empty()) outputs_.push_back({option, path == "-" ? kStandardOutput : path, std::move(write)});
}

void Outputs::check(const std::vector<std::string>& inputs) const {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const std::string& path = outputs_[i].path;
    // Two results into /dev/null do no harm; into one pipe they would.
    if (isStream(path) && path != kStandardOutput) continue;
    for (std::size_t j = i + 1; j < outputs_.size(); ++j) {
      if (sameFile(path, outputs_[j].path)) failUsage("{} and {} name the same file, {}", outputs_[i].option, outputs_[j].option, path);
    }
    for (const std::string& input : inputs) {
      if (sameFile(path, input)) failUsage("{} would overwrite the input {}", outputs_[i].option, input);
    }
  }
  for (const Output& output : outputs_) checkPlace(output.path);
}

void Outputs::write() const {
  for (const Output& output : outputs_) output.write(output.path);
}

}  // namespace copeel
