// openscad 2021.01 writes "ERROR: cause in file F, line N", with F quoted or not, relative to its source or not, or with no place at all.
#include "apps/csg/openscad_log.h"

#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

namespace copeel::csg {
namespace {

bool takePrefix(std::string& line, const std::string& prefix) {
  if (line.compare(0, prefix.size(), prefix) != 0) return false;
  line.erase(0, prefix.size());
  return true;
}

// "cause in file F, line N" to "F:N: cause".
std::string located(std::string message, const std::string& source, const std::string& shownAs, SourceLines lines) {
  while (!message.empty() && (message.back() == ' ' || message.back() == '\r')) message.pop_back();
  const std::size_t place = message.rfind(" in file ");
  const std::size_t line = message.rfind(", line ");
  if (place == std::string::npos || line == std::string::npos || line < place) return fmt::format("{}: {}", shownAs, message);
  std::string file = message.substr(place + 9, line - place - 9);
  if (file.size() >= 2 && file.front() == '"' && file.back() == '"') file = file.substr(1, file.size() - 2);
  std::string number = message.substr(line + 7);
  number = number.substr(0, number.find_first_not_of("0123456789"));
  const bool isSource = std::filesystem::path(file).filename() == std::filesystem::path(source).filename();
  if (isSource && lines == SourceLines::Meaningless) return fmt::format("{}: {}", shownAs, message.substr(0, place));
  return fmt::format("{}:{}: {}", isSource ? shownAs : file, number, message.substr(0, place));
}

}  // namespace

OpenscadLog readOpenscadLog(const std::string& logPath, const std::string& source, const std::string& shownAs, SourceLines lines) {
  OpenscadLog log;
  std::ifstream file(logPath);
  for (std::string line; std::getline(file, line);) {
    if (line.find("op level object is empty") != std::string::npos) log.emptyObject = true;
    if (takePrefix(line, "ERROR: ")) {
      log.errors.push_back(located(line, source, shownAs, lines));
    } else if (takePrefix(line, "WARNING: ")) {
      std::string warning = located(line, source, shownAs, lines);
      if (std::find(log.warnings.begin(), log.warnings.end(), warning) == log.warnings.end()) log.warnings.push_back(std::move(warning));
    } else if (line.compare(0, 10, "Can't open") == 0 || line.compare(0, 11, "Can't parse") == 0) {
      if (log.errors.empty()) log.errors.push_back(fmt::format("{}: {}", shownAs, line));
    }
  }
  return log;
}

}  // namespace copeel::csg
