// Walks over the text of a source: tokens, numbers and line ends, without copying and without counting lines.
// A token is a run of bytes other than blanks, line ends and (where a comment character is given) comments.
#pragma once

#include <cstdint>
#include <string_view>

#include <glm/vec3.hpp>

#include "core/formats/input_file.h"

namespace copeel {

class TextCursor {
 public:
  // A comment runs from the character to the end of its line; '\0' where the format has none.
  explicit TextCursor(const Source& source, std::size_t start = 0, char comment = '\0')
      : source_(&source), at_(source.data() + start), end_(source.data() + source.size()), comment_(comment) {}

  std::size_t place() const { return static_cast<std::size_t>(at_ - source_->data()); }
  bool atEnd();      // nothing but white space and comments is left; they are skipped
  bool atLineEnd();  // likewise for this line; the line end itself is not skipped
  void skipLine();   // to the first byte of the next line

  std::string_view token();       // across line ends; empty at the end of the source
  std::string_view lineToken();   // of this line; empty at its end
  std::string_view restOfLine();  // without the line end, which is skipped

  // The next token (across line ends) as a value; `what` names it in the error. Numbers are finite: nan, inf and 1e400 are errors.
  double number(const char* what);
  std::int64_t integer(const char* what);
  glm::dvec3 point(const char* what) {
    const double x = number(what), y = number(what);
    return {x, y, number(what)};
  }

  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    source_->failAtLine(tokenPlace_, format, std::forward<Args>(args)...);
  }

 private:
  void skipBlanks();
  void skipWhite();
  std::string_view takeToken();

  const Source* source_;
  const char* at_;
  const char* end_;
  char comment_;
  std::size_t tokenPlace_ = 0;  // where the last token began: the line that an error names
};

// The value of a whole token; false when it is anything else. An integer saturates nowhere: out of range is false too.
enum class NumberFault { None, NotANumber, NotFinite };
NumberFault parseNumber(std::string_view token, double& value);
bool parseInteger(std::string_view token, std::int64_t& value);

}  // namespace copeel
