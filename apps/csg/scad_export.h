// openscad at work on a .scad, beside us.
//
// Of its 25 ms, 20 go by before it reads a line (90 libraries are linked), and 3 after it has written the last one. So it writes into a
// named pipe: the text is whole when openscad closes it, and its way out passes while the model is drawn. What it says is read once more at
// its end, before anything is made of the picture.
#pragma once

#include <string>
#include <vector>

#include "apps/csg/named_pipe.h"
#include "apps/csg/process.h"
#include "apps/csg/read_model.h"

namespace copeel::csg {

class ScadExport {
 public:
  // Starts openscad. Throws Error{Input} for a file that cannot be read, Error{Machine} where openscad cannot be run.
  ScadExport(const std::string& path, const ReadOptions& options);

  // Waits for the text. Throws Error{Input} (file, line, cause) or Error{Machine}; where openscad failed, its cause rather than ours.
  Model model();

  // Waits for openscad's end, after model(). Throws where it failed after all; gives the warnings that came after the text.
  std::vector<std::string> finish();

 private:
  Command command() const;

  const std::string path_, source_;
  const ReadOptions options_;
  const TemporaryFolder temporary_;
  NamedPipe pipe_;
  Process process_;
  std::size_t warningsSeen_ = 0;
};

}  // namespace copeel::csg
