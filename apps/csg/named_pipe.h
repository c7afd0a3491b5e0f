// A file name under which another program's output is read as it is written.
#pragma once

#include <optional>
#include <string>

#include "apps/csg/process.h"

namespace copeel::csg {

class NamedPipe {
 public:
  explicit NamedPipe(const std::string& name);   // Error{Machine} where it cannot be made
  ~NamedPipe();                                  // the name stays
  NamedPipe(const NamedPipe&) = delete;
  NamedPipe& operator=(const NamedPipe&) = delete;

  // All that `writer` puts there until it closes the file; nullopt where it ends without having written anything. Once only.
  std::optional<std::string> read(const Process& writer);

 private:
  void closeWriter();

  int ends_[2] = {-1, -1};
};

}  // namespace copeel::csg
