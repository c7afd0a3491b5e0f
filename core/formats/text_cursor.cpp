// Numbers go through std::from_chars: correctly rounded, independent of the locale, and several times faster than streams or strtod.
#include "core/formats/text_cursor.h"

#include <charconv>
#include <clocale>
#include <cmath>
#include <cstdlib>
#include <string>

namespace copeel {
namespace {

bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
bool isLineEnd(char c) { return c == '\n' || c == '\r'; }

// from_chars takes no leading plus sign, files have them.
std::string_view withoutPlus(std::string_view token) {
  if (token.size() > 1 && token[0] == '+' && token[1] != '-' && token[1] != '+') token.remove_prefix(1);
  return token;
}

// from_chars reports "out of range" for 1e400 and for 1e-400 alike and leaves no value; strtod tells them apart.
double outOfRangeValue(std::string_view token) {
  static const locale_t plain = ::newlocale(LC_ALL_MASK, "C", nullptr);
  return ::strtod_l(std::string(token).c_str(), nullptr, plain);
}

}  // namespace

NumberFault parseNumber(std::string_view token, double& value) {
  const std::string_view digits = withoutPlus(token);
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::invalid_argument || stop != digits.data() + digits.size()) return NumberFault::NotANumber;
  if (error == std::errc::result_out_of_range) value = outOfRangeValue(digits);
  return std::isfinite(value) ? NumberFault::None : NumberFault::NotFinite;
}

bool parseInteger(std::string_view token, std::int64_t& value) {
  const std::string_view digits = withoutPlus(token);
  const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  return error == std::errc() && stop == digits.data() + digits.size();
}

void TextCursor::skipBlanks() {
  while (at_ != end_ && isBlank(*at_)) ++at_;
  if (at_ != end_ && comment_ != '\0' && *at_ == comment_) {
    while (at_ != end_ && !isLineEnd(*at_)) ++at_;
  }
}

void TextCursor::skipWhite() {
  for (skipBlanks(); at_ != end_ && isLineEnd(*at_); skipBlanks()) ++at_;
}

std::string_view TextCursor::takeToken() {
  const char* start = at_;
  tokenPlace_ = place();
  while (at_ != end_ && !isBlank(*at_) && !isLineEnd(*at_) && (comment_ == '\0' || *at_ != comment_)) ++at_;
  return {start, static_cast<std::size_t>(at_ - start)};
}

bool TextCursor::atEnd() {
  skipWhite();
  return at_ == end_;
}

bool TextCursor::atLineEnd() {
  skipBlanks();
  return at_ == end_ || isLineEnd(*at_);
}

void TextCursor::skipLine() { restOfLine(); }

std::string_view TextCursor::token() {
  skipWhite();
  return takeToken();
}

std::string_view TextCursor::lineToken() {
  skipBlanks();
  return takeToken();
}

std::string_view TextCursor::restOfLine() {
  const char* start = at_;
  while (at_ != end_ && !isLineEnd(*at_)) ++at_;
  const std::string_view rest(start, static_cast<std::size_t>(at_ - start));
  if (at_ != end_ && *at_ == '\r') {
    ++at_;
    if (at_ != end_ && *at_ == '\n') ++at_;
  } else if (at_ != end_) {
    ++at_;
  }
  return rest;
}

double TextCursor::number(const char* what) {
  const std::string_view text = token();
  if (text.empty()) fail("the file ends where {} should be", what);
  double value = 0;
  switch (parseNumber(text, value)) {
    case NumberFault::None:
      break;
    case NumberFault::NotANumber:
      fail("{} should be here, found {}", what, quoted(text));
    case NumberFault::NotFinite:
      fail("{} is not a finite number: {}", what, quoted(text));
  }
  return value;
}

std::int64_t TextCursor::integer(const char* what) {
  const std::string_view text = token();
  if (text.empty()) fail("the file ends where {} should be", what);
  std::int64_t value = 0;
  if (!parseInteger(text, value)) fail("{} should be here, found {}", what, quoted(text));
  return value;
}

}  // namespace copeel
