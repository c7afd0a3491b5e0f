// The files a command writes. Each appears whole or not at all (core/output_file.h); what can be said against them is said before the work.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace copeel {

class Outputs {
 public:
  // An empty path is no output, "-" is standard output. `write` makes the file, through a function of core that writes it whole.
  void add(const std::string& option, const std::string& path, std::function<void(const std::string& path)> write);

  // Throws Error{Usage} when two outputs, or an output and an input, are one file, and Error{Machine} when a target cannot be
  // written, so that nobody waits for a picture that has no place.
  void check(const std::vector<std::string>& inputs) const;

  // In the order of add(); the first failure leaves the later ones unwritten. Throws Error{Machine}.
  void write() const;

 private:
  struct Output {
    std::string option;   // for messages
    std::string path;
    std::function<void(const std::string&)> write;
  };
  std::vector<Output> outputs_;
};

// A device or a pipe, which has no ending to its name and may be named twice.
bool isStream(const std::string& path);

}  // namespace copeel
