// The text of a .csg file as flat arrays: what was written, before it means anything.
//
// Nodes stand in the order of the text (a parent before its children); values stand on a tape on which a vector is followed by its
// items. Nothing here recurses, so a nesting of a million levels costs memory only. Cost: one pass over the text, about 16 bytes a value.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copeel::csg {

enum class Keyword : std::uint8_t {
  Group, Union, Difference, Intersection, Multmatrix, Color, Render,                    // trees
  Cube, Sphere, Cylinder, Polyhedron, LinearExtrude, RotateExtrude, Import,             // solids
  Square, Circle, Polygon,                                                              // flat shapes
  Text, Offset, Hull, Minkowski, Projection, Surface, Resize,                           // evaluated by openscad itself
};

enum Modifier : std::uint8_t { kBackground = 1, kHighlight = 2, kRoot = 4, kDisabled = 8 };   // % # ! *

enum class ValueKind : std::uint8_t { Undef, Bool, Number, String, Vector };

struct Value {
  static constexpr std::uint32_t kMostLength = (1u << 28) - 1;

  std::uint32_t textBegin = 0;      // bytes of the source; of a string, without its quotes
  std::uint32_t length : 28;        // Vector: items on its first level; of an item of a range 0; else bytes of the source
  ValueKind kind : 3;
  bool rawString : 1;               // text() writes its strings without escapes
  union {
    double number;                  // Number, Bool (0 or 1)
    std::uint64_t tapeEnd;          // Vector: index past its last descendant
  };
  Value() : length(0), kind(ValueKind::Undef), rawString(false), number(0) {}
  std::uint32_t itemCount() const { return kind == ValueKind::Vector ? length : 0; }
  std::uint32_t textLength() const { return kind == ValueKind::Vector ? 0 : length; }
};
static_assert(sizeof(Value) == 16);

struct Argument {
  std::uint32_t nameBegin = 0;
  std::uint32_t nameLength = 0;     // 0: positional
  std::uint32_t value = 0;          // index on the tape
};

struct SyntaxNode {
  Keyword keyword = Keyword::Group;
  std::uint8_t modifiers = 0;
  std::uint32_t textBegin = 0;      // of the name, after modifiers
  std::uint32_t textEnd = 0;        // past the ; or } that ends it
  std::uint32_t headEnd = 0;        // past the ) of its arguments
  std::uint32_t firstArgument = 0;
  std::uint32_t argumentCount = 0;
  std::uint32_t subtreeEnd = 0;     // index past its last descendant: the next sibling
};

struct SyntaxTree {
  std::string_view text;
  std::string name;                 // stands in messages
  std::vector<SyntaxNode> nodes;    // a node's first child, if any, is the next node
  std::vector<Argument> arguments;
  std::vector<Value> tape;

  // The index of the item after `value` on the same level.
  std::size_t next(std::size_t value) const {
    return tape[value].kind == ValueKind::Vector ? static_cast<std::size_t>(tape[value].tapeEnd) : value + 1;
  }
  // The argument of this name, or the positional one, or null.
  const Value* find(const SyntaxNode& node, std::string_view name, int position = -1) const;
  std::string_view textOf(const Value& value) const { return text.substr(value.textBegin, value.textLength()); }
  std::string stringOf(const Value& value) const;       // escapes undone
  std::string_view nameOf(const SyntaxNode& node) const;
  std::size_t lineAt(std::size_t offset) const;
  [[noreturn]] void fail(std::size_t offset, const std::string& cause) const;

 private:
  mutable std::vector<std::uint32_t> lineEnds_;          // found when a message first needs a line
};

// Throws Error{Input} "name:line: cause". `text` must outlive the tree.
SyntaxTree parseSyntax(std::string_view text, const std::string& name);

}  // namespace copeel::csg
