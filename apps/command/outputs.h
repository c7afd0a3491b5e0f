// The files a command writes: all of them appear, whole, or none.
//
// Each is first written into a temporary folder beside its target and renamed at the end. What is not a plain file (/dev/stdout, a pipe,
// "-" for standard output) cannot be renamed over: it is staged in the system's temporary folder and copied at the end.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "apps/command/interrupts.h"

namespace copeel {

class Outputs {
 public:
  // Before the work: throws Error{Usage} when two outputs, or an output and an input, are one file, and Error{Machine} when a
  // target's folder cannot be written, so that nobody waits for a picture that has no place. An empty path is no output.
  void add(const std::string& option, const std::string& path, std::function<void(const std::string& path)> write);
  void check(const std::vector<std::string>& inputs) const;

  // Calls the writers and puts the files into their places. Throws Error{Machine}; then no output was touched, save that
  // a rename or copy that fails half-way leaves the earlier outputs, whole.
  void commit() const;

 private:
  struct Output {
    std::string option;   // for messages
    std::string path;     // as given
    std::function<void(const std::string&)> write;
  };
  std::vector<Output> outputs_;
};

// Writes text to a new file. Throws Error{Machine}.
void writeText(const std::string& path, const std::string& text);

}  // namespace copeel
