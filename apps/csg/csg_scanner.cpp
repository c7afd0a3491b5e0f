#include "apps/csg/csg_scanner.h"

#include <charconv>
#include <cstdlib>

#include <fmt/format.h>

namespace copeel::csg {
namespace {

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

// Out of double's range means too large or too small: strtod tells which.
double outOfRange(const char* begin, const char* end) { return std::strtod(std::string(begin, end).c_str(), nullptr); }

}  // namespace

Scanner::Scanner(const SyntaxTree& tree) : tree_(tree), text_(tree.text) {
  if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
}

void Scanner::skipSpace() {
  at_ = skipSpaceFrom(at_);
  while (at_ + 1 < text_.size() && text_[at_] == '/' && (text_[at_ + 1] == '/' || text_[at_ + 1] == '*')) skipComment();
}

void Scanner::skipComment() {
  const std::string_view end = text_[at_ + 1] == '/' ? "\n" : "*/";
  const std::size_t found = text_.find(end, at_ + 2);
  if (found == std::string_view::npos && end == "*/") tree_.fail(at_, "the comment has no end");
  at_ = skipSpaceFrom(found == std::string_view::npos ? text_.size() : found + end.size());
}

std::size_t Scanner::skipSpaceFrom(std::size_t i) const {
  while (i < text_.size() && isSpace(text_[i])) ++i;
  return i;
}

bool Scanner::passIf(char c) {
  skipSpace();
  if (atEnd() || text_[at_] != c) return false;
  ++at_;
  return true;
}

void Scanner::expect(char c) {
  if (!passIf(c)) tree_.fail(at_, unexpected(std::string(1, c)));
}

std::string_view Scanner::readName() {
  const std::size_t begin = at_;
  while (at_ < text_.size() && isNameByte(text_[at_])) ++at_;
  return text_.substr(begin, at_ - begin);
}

// std::from_chars knows nan, inf and every decimal, and neither a locale nor an allocation.
double Scanner::readNumber() {
  const char* const begin = text_.data() + at_;
  const char* const end = text_.data() + text_.size();
  const char* digits = begin;
  bool negative = false;
  while (digits < end && (*digits == '-' || *digits == '+')) negative ^= *digits++ == '-';
  double number = 0;
  const auto [stop, status] = std::from_chars(digits, end, number);
  if (status == std::errc::invalid_argument || (stop < end && isNameByte(*stop))) tree_.fail(at_, unexpected("a value"));
  if (status == std::errc::result_out_of_range) number = outOfRange(digits, stop);
  at_ += static_cast<std::size_t>(stop - begin);
  return negative ? -number : number;
}

std::string_view Scanner::readString(bool raw) {
  const std::size_t begin = at_ + 1;
  const std::size_t end = raw ? endOfRawString(begin) : endOfString(begin);
  if (end >= text_.size()) tree_.fail(at_, "the string has no end");
  at_ = end + 1;
  return text_.substr(begin, end - begin);
}

std::size_t Scanner::endOfString(std::size_t i) const {
  while (i < text_.size() && text_[i] != '"') i += text_[i] == '\\' ? 2 : 1;
  return i;
}

// openscad 2021.01 writes the strings of text() as they are, quotes included, so the end is the quote that the grammar can follow:
// one before ", name =" or before ");".
std::size_t Scanner::endOfRawString(std::size_t i) const {
  for (; i < text_.size(); ++i) {
    if (text_[i] != '"') continue;
    std::size_t j = skipSpaceFrom(i + 1);
    if (j >= text_.size()) return text_.size();
    if (text_[j] == ')') return i;
    if (text_[j] != ',') continue;
    j = skipSpaceFrom(j + 1);
    const std::size_t name = j;
    while (j < text_.size() && isNameByte(text_[j])) ++j;
    if (j > name && text_.substr(skipSpaceFrom(j), 1) == "=") return i;
  }
  return text_.size();
}

std::string Scanner::unexpected(const std::string& expected) const {
  if (atEnd()) return fmt::format("the file ends where {} should be", expected);
  return fmt::format("expected {}, found '{}'", expected, shown(text_.substr(at_, 12)));
}

std::string Scanner::shown(std::string_view bytes) {
  std::string result;
  for (const char c : bytes.substr(0, 40)) {
    if (c == '\n' || c == '\r') break;
    const bool printable = static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F;
    result += printable ? c : '?';
  }
  return result;
}

}  // namespace copeel::csg
