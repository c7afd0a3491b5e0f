// What openscad printed, as lines that name file, line and cause.
#pragma once

#include <string>
#include <vector>

namespace copeel::csg {

struct OpenscadLog {
  std::vector<std::string> errors;      // "file:line: cause"
  std::vector<std::string> warnings;    // likewise, each once
  bool emptyObject = false;             // it found nothing to export
};

// Meaningless where the text is one of ours, of which the user knows nothing.
enum class SourceLines { Shown, Meaningless };

// `source` is the file that was given to openscad; messages about it name it as the user did.
OpenscadLog readOpenscadLog(const std::string& logPath, const std::string& source, const std::string& shownAs, SourceLines lines = SourceLines::Shown);

}  // namespace copeel::csg
