// The words of a .csg: names, numbers, the ends of strings, and what lies between them. It stands on a byte of the text and moves on.
#pragma once

#include <string>
#include <string_view>

#include "apps/csg/csg_syntax.h"

namespace copeel::csg {

inline bool isNameByte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
}

class Scanner {
 public:
  // Begins after a byte order mark. The tree lends its text and its way to fail.
  explicit Scanner(const SyntaxTree& tree);

  std::size_t at() const { return at_; }
  bool atEnd() const { return at_ >= text_.size(); }
  char peek() const { return atEnd() ? '\0' : text_[at_]; }
  void pass() { ++at_; }                    // the byte that peek has shown
  void goBack(std::size_t at) { at_ = at; }
  void skipSpace();                         // and comments
  bool passIf(char c);                      // after space
  void expect(char c);                      // after space

  std::string_view readName();              // empty where none stands
  double readNumber();
  // From its quote to past its end; returns what is between. `raw`: as text() writes its strings, without escapes.
  std::string_view readString(bool raw);

  std::string unexpected(const std::string& expected) const;
  // What a message may quote: one line of printable bytes.
  static std::string shown(std::string_view bytes);

 private:
  void skipComment();
  std::size_t skipSpaceFrom(std::size_t i) const;
  std::size_t endOfString(std::size_t i) const;
  std::size_t endOfRawString(std::size_t i) const;

  const SyntaxTree& tree_;
  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace copeel::csg
