// What a syntax tree can be asked.
#include "apps/csg/csg_syntax.h"

#include <algorithm>
#include <cstdlib>

#include "apps/csg/csg_scanner.h"
#include "core/error.h"

namespace copeel::csg {
namespace {

// The bytes of one code point; 0 and what is no code point give nothing.
void appendUtf8(std::string& out, unsigned long c) {
  if (c == 0 || c > 0x10FFFF) return;
  if (c < 0x80) {
    out += static_cast<char>(c);
  } else if (c < 0x800) {
    out += static_cast<char>(0xC0 | (c >> 6));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    out += static_cast<char>(0xE0 | (c >> 12));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  } else {
    out += static_cast<char>(0xF0 | (c >> 18));
    out += static_cast<char>(0x80 | ((c >> 12) & 0x3F));
    out += static_cast<char>(0x80 | ((c >> 6) & 0x3F));
    out += static_cast<char>(0x80 | (c & 0x3F));
  }
}

}  // namespace

const Value* SyntaxTree::find(const SyntaxNode& node, std::string_view wanted, int position) const {
  int unnamed = 0;
  const Value* result = nullptr;
  for (std::uint32_t i = 0; i < node.argumentCount; ++i) {
    const Argument& argument = arguments[node.firstArgument + i];
    const std::string_view argumentName = text.substr(argument.nameBegin, argument.nameLength);
    if (argumentName.empty() ? unnamed++ == position : argumentName == wanted) result = &tape[argument.value];
  }
  return result;
}

std::string SyntaxTree::stringOf(const Value& value) const {
  const std::string_view raw = textOf(value);
  if (value.rawString || raw.find('\\') == std::string_view::npos) return std::string(raw);
  std::string result;
  for (std::size_t i = 0; i < raw.size(); ++i) {
    if (raw[i] != '\\' || i + 1 == raw.size()) {
      result += raw[i];
      continue;
    }
    const char c = raw[++i];
    const std::size_t hexDigits = c == 'x' ? 2 : c == 'u' ? 4 : c == 'U' ? 6 : 0;
    if (hexDigits > 0) {
      const std::string digits(raw.substr(i + 1, hexDigits));
      appendUtf8(result, std::strtoul(digits.c_str(), nullptr, 16));
      i += digits.size();
    } else {
      result += c == 'n' ? '\n' : c == 't' ? '\t' : c == 'r' ? '\r' : c;
    }
  }
  return result;
}

std::string_view SyntaxTree::nameOf(const SyntaxNode& node) const {
  std::size_t end = node.textBegin;
  while (end < text.size() && isNameByte(text[end])) ++end;
  return text.substr(node.textBegin, end - node.textBegin);
}

// There may be a warning on each line: counting anew for every one would take the square of the file's size.
std::size_t SyntaxTree::lineAt(std::size_t offset) const {
  if (lineEnds_.empty()) {
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1)) {
      lineEnds_.push_back(static_cast<std::uint32_t>(at));
    }
    lineEnds_.push_back(~std::uint32_t{0});
  }
  return 1 + static_cast<std::size_t>(std::lower_bound(lineEnds_.begin(), lineEnds_.end(), offset) - lineEnds_.begin());
}

void SyntaxTree::fail(std::size_t offset, const std::string& cause) const { failInput("{}:{}: {}", name, lineAt(offset), cause); }

}  // namespace copeel::csg
