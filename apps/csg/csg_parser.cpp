// The grammar: statement = modifier* name ( arguments ) then ; or { statements } or one statement. The open statements stand on a stack
// of their own, as do the open vectors of a value.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "apps/csg/csg_scanner.h"
#include "apps/csg/csg_syntax.h"

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

std::uint32_t narrow(std::size_t n) { return static_cast<std::uint32_t>(n); }

class Parser {
 public:
  explicit Parser(SyntaxTree& tree) : tree_(tree), in_(tree) {}

  void run() {
    if (tree_.text.size() > std::numeric_limits<std::uint32_t>::max() / 2) tree_.fail(0, "the file is larger than 2 GB");
    reserve();
    for (in_.skipSpace(); !in_.atEnd(); in_.skipSpace()) step();
    if (!open_.empty()) tree_.fail(in_.at(), openMessage());
  }

 private:
  struct Open {
    std::uint32_t node;
    bool braces;     // else it waits for its only child
  };

  void reserve() {
    // A value comes after one of these. A tape that had to grow would be held twice.
    const auto leads = [](char c) { return (c == ',') | (c == '[') | (c == '=') | (c == '(') | (c == ':'); };
    const auto values = std::count_if(tree_.text.begin(), tree_.text.end(), leads);
    tree_.tape.reserve(std::min<std::size_t>(static_cast<std::size_t>(values), std::size_t{1} << 25));
    tree_.nodes.reserve(tree_.text.size() / 100);
    tree_.arguments.reserve(tree_.text.size() / 40);
  }

  void step() {
    if (in_.peek() == '}') {
      if (open_.empty() || !open_.back().braces) tree_.fail(in_.at(), "unexpected }");
      in_.pass();
      close(open_.back().node);
    } else if (in_.peek() == ';') {
      if (!open_.empty() && !open_.back().braces) tree_.fail(in_.at(), "unexpected ;");
      in_.pass();
    } else {
      statement();
    }
  }

  void statement() {
    const std::uint8_t modifiers = readModifiers();
    const std::size_t begin = in_.at();
    const std::string_view name = in_.readName();
    if (name.empty()) tree_.fail(in_.at(), in_.unexpected("a node such as cube(...)"));
    const std::optional<Keyword> keyword = keywordOf(name);
    if (!keyword) tree_.fail(begin, fmt::format("unknown node '{}'", Scanner::shown(name)));
    const std::uint32_t index = narrow(tree_.nodes.size());
    SyntaxNode node;
    node.keyword = *keyword;
    node.modifiers = modifiers;
    node.textBegin = narrow(begin);
    node.firstArgument = narrow(tree_.arguments.size());
    inText_ = *keyword == Keyword::Text;
    readArguments();
    node.argumentCount = narrow(tree_.arguments.size()) - node.firstArgument;
    node.headEnd = narrow(in_.at());
    tree_.nodes.push_back(node);
    in_.skipSpace();
    if (in_.atEnd()) tree_.fail(in_.at(), "the file ends before ; or {");
    if (in_.passIf(';')) {
      finish(index);
    } else {
      open_.push_back({index, in_.passIf('{')});
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
    tree_.nodes[index].textEnd = narrow(in_.at());
  }

  std::uint8_t readModifiers() {
    std::uint8_t modifiers = 0;
    for (in_.skipSpace(); !in_.atEnd(); in_.skipSpace()) {
      switch (in_.peek()) {
        case '%': modifiers |= kBackground; break;
        case '#': modifiers |= kHighlight; break;
        case '!': modifiers |= kRoot; break;
        case '*': modifiers |= kDisabled; break;
        default: return modifiers;
      }
      in_.pass();
    }
    return modifiers;
  }

  void readArguments() {
    in_.expect('(');
    if (in_.passIf(')')) return;
    do readArgument();
    while (in_.passIf(','));
    in_.expect(')');
  }

  void readArgument() {
    Argument argument;
    in_.skipSpace();
    const std::size_t before = in_.at();
    const std::string_view name = in_.readName();
    if (!name.empty() && in_.passIf('=')) {
      argument.nameBegin = narrow(before);
      argument.nameLength = narrow(name.size());
    } else {
      in_.goBack(before);
    }
    argument.value = narrow(tree_.tape.size());
    readValue();
    tree_.arguments.push_back(argument);
  }

  // One value; nested vectors wait on vectors_ until their ].
  void readValue() {
    vectors_.clear();
    do {
      if (in_.passIf('[')) {
        openVector();
        in_.skipSpace();
        if (in_.peek() != ']') continue;
      } else if (!vectors_.empty() && in_.peek() == ']') {
        // A trailing comma, as people write it.
      } else {
        readScalar();
        if (!vectors_.empty()) countItem();
      }
      closeVectors();
    } while (!vectors_.empty());
  }

  std::uint32_t lengthOf(std::size_t length) {
    if (length > Value::kMostLength) tree_.fail(in_.at(), "a value is too long");
    return narrow(length);
  }

  // Of the innermost open vector.
  void countItem() {
    Value& vector = tree_.tape[vectors_.back()];
    vector.length = lengthOf(std::size_t{vector.length} + 1);
  }

  void openVector() {
    if (!vectors_.empty()) countItem();
    Value vector;
    vector.kind = ValueKind::Vector;
    vector.textBegin = narrow(in_.at() - 1);
    vector.tapeEnd = 0;
    vectors_.push_back(narrow(tree_.tape.size()));
    tree_.tape.push_back(vector);
  }

  // After an item: a comma leads to the next one, any number of ] close vectors.
  void closeVectors() {
    while (!vectors_.empty()) {
      if (in_.passIf(',')) return;
      if (in_.peek() == ':') {
        readRange();
        continue;
      }
      if (!in_.passIf(']')) tree_.fail(in_.at(), in_.unexpected(", or ]"));
      tree_.tape[vectors_.back()].tapeEnd = tree_.tape.size();
      vectors_.pop_back();
    }
  }

  // [a : b] or [a : step : b], written out as its items.
  void readRange() {
    Value& vector = tree_.tape[vectors_.back()];
    const std::size_t begin = in_.at();
    const bool hasBegin = tree_.tape.size() == vectors_.back() + 2u && tree_.tape.back().kind == ValueKind::Number;
    if (!hasBegin) tree_.fail(in_.at(), "unexpected :");
    const double first = tree_.tape.back().number;
    tree_.tape.pop_back();
    vector.length = 0;
    double bounds[2] = {1, 1};
    int count = 0;
    while (count < 2 && in_.passIf(':')) {
      in_.skipSpace();
      bounds[count++] = in_.readNumber();
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
      countItem();
    }
  }

  void readScalar() {
    const char c = in_.peek();
    if (c == '"') return readString();
    if ((c >= 'a' && c <= 'z') && c != 'n' && c != 'i') return readWord();
    Value value;
    value.kind = ValueKind::Number;
    value.textBegin = narrow(in_.at());
    value.number = in_.readNumber();
    value.length = lengthOf(in_.at() - value.textBegin);
    tree_.tape.push_back(value);
  }

  void readWord() {
    Value value;
    value.textBegin = narrow(in_.at());
    const std::string_view word = in_.readName();
    value.length = lengthOf(word.size());
    if (word == "true" || word == "false") {
      value.kind = ValueKind::Bool;
      value.number = word == "true" ? 1 : 0;
    } else if (word != "undef") {
      tree_.fail(value.textBegin, fmt::format("'{}' is no value", Scanner::shown(word)));
    }
    tree_.tape.push_back(value);
  }

  void readString() {
    Value value;
    value.kind = ValueKind::String;
    value.textBegin = narrow(in_.at() + 1);
    value.rawString = inText_;
    value.length = lengthOf(in_.readString(inText_).size());
    tree_.tape.push_back(value);
  }

  static std::optional<Keyword> keywordOf(std::string_view name) {
    for (const auto& [word, keyword] : kKeywords) {
      if (word == name) return keyword;
    }
    return std::nullopt;
  }

  std::string openMessage() const {
    const SyntaxNode& node = tree_.nodes[open_.back().node];
    return fmt::format("the file ends within {} of line {}", tree_.nameOf(node), tree_.lineAt(node.textBegin));
  }

  SyntaxTree& tree_;
  Scanner in_;
  bool inText_ = false;   // the arguments are those of text()
  std::vector<Open> open_;
  std::vector<std::uint32_t> vectors_;
};

}  // namespace

SyntaxTree parseSyntax(std::string_view text, const std::string& name) {
  SyntaxTree tree;
  tree.text = text;
  tree.name = name;
  Parser(tree).run();
  return tree;
}

}  // namespace copeel::csg
