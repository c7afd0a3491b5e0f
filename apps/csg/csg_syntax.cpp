// The grammar: statement = modifier* name ( arguments ) then ; or { statements } or one statement. The open statements stand on a stack
// of their own, as do the open vectors of a value.
#include "apps/csg/csg_syntax.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <utility>

#include "core/error.h"

namespace copeel::csg {
namespace {

// A range may not grow a small file into all of the memory.
constexpr double kMaxRangeItems = 1e6;

constexpr std::array<std::pair<std::string_view, Keyword>, 26> kKeywords{{
    {"group", Keyword::Group}, {"multmatrix", Keyword::Multmatrix}, {"cylinder", Keyword::Cylinder}, {"cube", Keyword::Cube},
    {"sphere", Keyword::Sphere}, {"difference", Keyword::Difference}, {"union", Keyword::Union},
    {"intersection", Keyword::Intersection}, {"color", Keyword::Color}, {"polyhedron", Keyword::Polyhedron},
    {"linear_extrude", Keyword::LinearExtrude}, {"rotate_extrude", Keyword::RotateExtrude}, {"square", Keyword::Square},
    {"circle", Keyword::Circle}, {"polygon", Keyword::Polygon}, {"import", Keyword::Import}, {"render", Keyword::Render},
    {"text", Keyword::Text}, {"offset", Keyword::Offset}, {"hull", Keyword::Hull}, {"minkowski", Keyword::Minkowski},
    {"projection", Keyword::Projection}, {"surface", Keyword::Surface}, {"resize", Keyword::Resize},
    {"import_stl", Keyword::Import}, {"import_off", Keyword::Import},
}};

bool isNameByte(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '$';
}

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }

class Parser {
 public:
  explicit Parser(SyntaxTree& tree) : tree_(tree), text_(tree.text) {}

  void run() {
    if (text_.size() > std::numeric_limits<std::uint32_t>::max() / 2) tree_.fail(0, "the file is larger than 2 GB");
    if (text_.substr(0, 3) == "\xEF\xBB\xBF") at_ = 3;
    reserve();
    for (skipSpace(); at_ < text_.size(); skipSpace()) step();
    if (!open_.empty()) tree_.fail(text_.size(), openMessage());
  }

 private:
  struct Open {
    std::uint32_t node;
    bool braces;     // else it waits for its only child
  };

  // Typical files hold a number every 8 bytes; growing the tape by copies would double the time of a large file.
  void reserve() {
    tree_.tape.reserve(std::min<std::size_t>(text_.size() / 7, std::size_t{1} << 25));
    tree_.nodes.reserve(text_.size() / 100);
    tree_.arguments.reserve(text_.size() / 40);
  }

  void step() {
    const char c = text_[at_];
    if (c == '}') {
      if (open_.empty() || !open_.back().braces) tree_.fail(at_, "unexpected }");
      ++at_;
      close(open_.back().node);
    } else if (c == ';') {
      if (!open_.empty() && !open_.back().braces) tree_.fail(at_, "unexpected ;");
      ++at_;
    } else {
      statement();
    }
  }

  void statement() {
    const std::uint8_t modifiers = readModifiers();
    const std::size_t begin = at_;
    const std::string_view name = readName();
    if (name.empty()) tree_.fail(at_, unexpected("a node such as cube(...)"));
    const std::optional<Keyword> keyword = keywordOf(name);
    if (!keyword) tree_.fail(begin, fmt::format("unknown node '{}'", shown(name)));
    const std::uint32_t index = narrow(tree_.nodes.size());
    SyntaxNode node;
    node.keyword = *keyword;
    node.modifiers = modifiers;
    node.textBegin = narrow(begin);
    node.firstArgument = narrow(tree_.arguments.size());
    inText_ = *keyword == Keyword::Text;
    readArguments();
    node.argumentCount = narrow(tree_.arguments.size()) - node.firstArgument;
    node.headEnd = narrow(at_);
    tree_.nodes.push_back(node);
    skipSpace();
    if (at_ >= text_.size()) tree_.fail(at_, "the file ends before ; or {");
    if (text_[at_] == ';') {
      ++at_;
      finish(index);
    } else if (text_[at_] == '{') {
      ++at_;
      open_.push_back({index, true});
    } else {
      open_.push_back({index, false});
    }
  }

  // Ends a node, and with it every node that waited for this one as its only child.
  void finish(std::uint32_t index) {
    setEnd(index);
    while (!open_.empty() && !open_.back().braces) {
      setEnd(open_.back().node);
      open_.pop_back();
    }
  }

  void close(std::uint32_t index) {
    open_.pop_back();
    finish(index);
  }

  void setEnd(std::uint32_t index) {
    tree_.nodes[index].subtreeEnd = narrow(tree_.nodes.size());
    tree_.nodes[index].textEnd = narrow(at_);
  }

  std::uint8_t readModifiers() {
    std::uint8_t modifiers = 0;
    for (skipSpace(); at_ < text_.size(); skipSpace()) {
      switch (text_[at_]) {
        case '%': modifiers |= kBackground; break;
        case '#': modifiers |= kHighlight; break;
        case '!': modifiers |= kRoot; break;
        case '*': modifiers |= kDisabled; break;
        default: return modifiers;
      }
      ++at_;
    }
    return modifiers;
  }

  void readArguments() {
    expect('(');
    skipSpace();
    if (peek() == ')') {
      ++at_;
      return;
    }
    for (;;) {
      readArgument();
      skipSpace();
      if (peek() == ',') {
        ++at_;
        continue;
      }
      expect(')');
      return;
    }
  }

  void readArgument() {
    Argument argument;
    skipSpace();
    const std::size_t before = at_;
    const std::string_view name = readName();
    skipSpace();
    if (!name.empty() && peek() == '=') {
      ++at_;
      argument.nameBegin = narrow(before);
      argument.nameLength = narrow(name.size());
    } else {
      at_ = before;
    }
    argument.value = narrow(tree_.tape.size());
    readValue();
    tree_.arguments.push_back(argument);
  }

  // One value; nested vectors wait on vectors_ until their ].
  void readValue() {
    vectors_.clear();
    do {
      skipSpace();
      if (peek() == '[') {
        ++at_;
        openVector();
        skipSpace();
        if (peek() != ']') continue;
      } else if (!vectors_.empty() && peek() == ']') {
        // A trailing comma, as people write it.
      } else {
        readScalar();
        if (!vectors_.empty()) ++tree_.tape[vectors_.back()].itemCount;
      }
      closeVectors();
    } while (!vectors_.empty());
  }

  void openVector() {
    if (!vectors_.empty()) ++tree_.tape[vectors_.back()].itemCount;
    Value vector;
    vector.kind = ValueKind::Vector;
    vector.textBegin = narrow(at_ - 1);
    vector.tapeEnd = 0;
    vectors_.push_back(narrow(tree_.tape.size()));
    tree_.tape.push_back(vector);
  }

  // After an item: a comma leads to the next one, any number of ] close vectors.
  void closeVectors() {
    while (!vectors_.empty()) {
      skipSpace();
      const char c = peek();
      if (c == ',') {
        ++at_;
        return;
      }
      if (c == ':') {
        readRange();
        continue;
      }
      if (c != ']') tree_.fail(at_, unexpected(", or ]"));
      ++at_;
      tree_.tape[vectors_.back()].tapeEnd = tree_.tape.size();
      vectors_.pop_back();
    }
  }

  // [a : b] or [a : step : b], written out as its items.
  void readRange() {
    Value& vector = tree_.tape[vectors_.back()];
    const std::size_t begin = at_;
    if (vector.itemCount != 1 || tree_.tape.back().kind != ValueKind::Number) tree_.fail(at_, "unexpected :");
    const double first = tree_.tape.back().number;
    tree_.tape.pop_back();
    vector.itemCount = 0;
    double bounds[2] = {1, 1};
    int count = 0;
    while (count < 2 && (skipSpace(), peek() == ':')) {
      ++at_;
      skipSpace();
      bounds[count++] = readNumber();
    }
    const double step = count == 2 ? bounds[0] : 1.0;
    const double last = count == 2 ? bounds[1] : bounds[0];
    const double items = std::floor((last - first) / step) + 1;
    if (!(std::abs(items) <= kMaxRangeItems)) tree_.fail(begin, "the range has too many items");
    for (int i = 0; i < items; ++i) {
      Value item;
      item.kind = ValueKind::Number;
      item.number = first + step * i;
      item.textBegin = narrow(begin);
      tree_.tape.push_back(item);
      ++tree_.tape[vectors_.back()].itemCount;
    }
  }

  void readScalar() {
    const char c = peek();
    if (c == '"') return readString();
    if ((c >= 'a' && c <= 'z') && c != 'n' && c != 'i') return readWord();
    Value value;
    value.kind = ValueKind::Number;
    value.textBegin = narrow(at_);
    value.number = readNumber();
    value.textLength = narrow(at_) - value.textBegin;
    tree_.tape.push_back(value);
  }

  void readWord() {
    Value value;
    value.textBegin = narrow(at_);
    const std::string_view word = readName();
    value.textLength = narrow(word.size());
    if (word == "true" || word == "false") {
      value.kind = ValueKind::Bool;
      value.number = word == "true" ? 1 : 0;
    } else if (word != "undef") {
      tree_.fail(value.textBegin, fmt::format("'{}' is no value", shown(word)));
    }
    tree_.tape.push_back(value);
  }

  // std::from_chars knows nan, inf and every decimal, and neither a locale nor an allocation.
  double readNumber() {
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

  // Out of double's range means too large or too small: strtod tells which.
  static double outOfRange(const char* begin, const char* end) { return std::strtod(std::string(begin, end).c_str(), nullptr); }

  void readString() {
    Value value;
    value.kind = ValueKind::String;
    value.textBegin = narrow(at_ + 1);
    const std::size_t end = inText_ ? endOfRawString(at_ + 1) : endOfString(at_ + 1);
    if (end >= text_.size()) tree_.fail(at_, "the string has no end");
    value.rawString = inText_;
    value.textLength = narrow(end) - value.textBegin;
    at_ = end + 1;
    tree_.tape.push_back(value);
  }

  std::size_t endOfString(std::size_t i) const {
    while (i < text_.size() && text_[i] != '"') i += text_[i] == '\\' ? 2 : 1;
    return i;
  }

  // openscad 2021.01 writes the strings of text() as they are, quotes included, so the end is the quote that the grammar can follow:
  // one before ", name =" or before ");".
  std::size_t endOfRawString(std::size_t i) const {
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

  std::string_view readName() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && isNameByte(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  static std::optional<Keyword> keywordOf(std::string_view name) {
    for (const auto& [word, keyword] : kKeywords) {
      if (word == name) return keyword;
    }
    return std::nullopt;
  }

  void skipSpace() {
    at_ = skipSpaceFrom(at_);
    while (at_ + 1 < text_.size() && text_[at_] == '/' && (text_[at_ + 1] == '/' || text_[at_ + 1] == '*')) skipComment();
  }

  void skipComment() {
    const std::string_view end = text_[at_ + 1] == '/' ? "\n" : "*/";
    const std::size_t found = text_.find(end, at_ + 2);
    if (found == std::string_view::npos && end == "*/") tree_.fail(at_, "the comment has no end");
    at_ = skipSpaceFrom(found == std::string_view::npos ? text_.size() : found + end.size());
  }

  std::size_t skipSpaceFrom(std::size_t i) const {
    while (i < text_.size() && isSpace(text_[i])) ++i;
    return i;
  }

  char peek() const { return at_ < text_.size() ? text_[at_] : '\0'; }

  void expect(char c) {
    skipSpace();
    if (at_ >= text_.size() || text_[at_] != c) tree_.fail(at_, unexpected(std::string(1, c)));
    ++at_;
  }

  std::string unexpected(const std::string& expected) const {
    if (at_ >= text_.size()) return fmt::format("the file ends where {} should be", expected);
    return fmt::format("expected {}, found '{}'", expected, shown(text_.substr(at_, 12)));
  }

  std::string openMessage() const {
    const SyntaxNode& node = tree_.nodes[open_.back().node];
    return fmt::format("the file ends within {} of line {}", tree_.nameOf(node), tree_.lineAt(node.textBegin));
  }

  // What a message may quote: one line of printable bytes.
  static std::string shown(std::string_view bytes) {
    std::string result;
    for (const char c : bytes.substr(0, 40)) {
      if (c == '\n' || c == '\r') break;
      const bool printable = static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F;
      result += printable ? c : '?';
    }
    return result;
  }

  SyntaxTree& tree_;
  std::string_view text_;
  std::size_t at_ = 0;
  bool inText_ = false;
  std::vector<Open> open_;
  std::vector<std::uint32_t> vectors_;
};

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

std::size_t SyntaxTree::lineAt(std::size_t offset) const {
  return 1 + static_cast<std::size_t>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(offset, text.size())), '\n'));
}

void SyntaxTree::fail(std::size_t offset, const std::string& cause) const { failInput("{}:{}: {}", name, lineAt(offset), cause); }

SyntaxTree parseSyntax(std::string_view text, const std::string& name) {
  SyntaxTree tree;
  tree.text = text;
  tree.name = name;
  Parser(tree).run();
  return tree;
}

}  // namespace copeel::csg
