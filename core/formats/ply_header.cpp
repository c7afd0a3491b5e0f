// Lines of words: format, element, property, comment, obj_info, end_header. Names refer to the source's bytes.
#include "core/formats/ply_header.h"

#include <algorithm>
#include <array>

#include "core/formats/text_cursor.h"

namespace copeel {
namespace {

struct TypeName {
  std::string_view classic, sized;
};
// In the order of PlyType.
constexpr std::array<TypeName, 8> kTypeNames = {{{"char", "int8"},
                                                 {"uchar", "uint8"},
                                                 {"short", "int16"},
                                                 {"ushort", "uint16"},
                                                 {"int", "int32"},
                                                 {"uint", "uint32"},
                                                 {"float", "float32"},
                                                 {"double", "float64"}}};

PlyType readType(TextCursor& cursor) {
  const std::string_view word = cursor.lineToken();
  for (std::size_t i = 0; i < kTypeNames.size(); ++i) {
    if (word == kTypeNames[i].classic || word == kTypeNames[i].sized) return static_cast<PlyType>(i);
  }
  cursor.fail("{} is no PLY type", quoted(word));
}

std::string_view readName(TextCursor& cursor) {
  const std::string_view name = cursor.lineToken();
  if (name.empty()) cursor.fail("a name is missing");
  return name;
}

PlyHeader::Encoding readEncoding(TextCursor& cursor) {
  const std::string_view word = cursor.lineToken();
  if (word == "ascii") return PlyHeader::Encoding::Ascii;
  if (word == "binary_little_endian") return PlyHeader::Encoding::LittleEndian;
  if (word == "binary_big_endian") return PlyHeader::Encoding::BigEndian;
  cursor.fail("{} is no PLY format", quoted(word));
}

PlyElement readElement(TextCursor& cursor) {
  PlyElement element;
  element.name = readName(cursor);
  const std::string_view word = cursor.lineToken();
  std::int64_t count = 0;
  if (!parseInteger(word, count) || count < 0)
    cursor.fail("the number of elements should be here, found {}", quoted(word));
  element.count = static_cast<std::uint64_t>(count);
  return element;
}

PlyProperty readProperty(TextCursor& cursor) {
  PlyProperty property;
  TextCursor ahead = cursor;
  if (ahead.lineToken() == "list") {
    cursor = ahead;
    property.isList = true;
    property.countType = readType(cursor);
    if (!isInteger(property.countType)) cursor.fail("the length of a list must be an integer");
  }
  property.type = readType(cursor);
  property.name = readName(cursor);
  return property;
}

// The byte after the line end of end_header. Only files whose first line ends in \r\n or a lone \r have them here: a binary body may begin with \n.
std::size_t bodyStart(const Source& source, std::size_t afterKeyword) {
  std::size_t at = afterKeyword;
  const auto byteAt = [&](std::size_t i) { return i < source.size() ? source.data()[i] : '\0'; };
  while (byteAt(at) == ' ' || byteAt(at) == '\t') ++at;
  std::size_t firstEnd = 0;
  while (byteAt(firstEnd) != '\n' && byteAt(firstEnd) != '\r') ++firstEnd;
  const bool loneReturn = byteAt(firstEnd) == '\r' && byteAt(firstEnd + 1) != '\n';
  if (byteAt(at) == '\r') return byteAt(at + 1) == '\n' && !loneReturn ? at + 2 : at + 1;
  if (byteAt(at) == '\n') return at + 1;
  if (at < source.size()) source.failAtLine(at, "the line should end after end_header");
  return at;
}

}  // namespace

std::size_t sizeBytes(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool isInteger(PlyType type) { return type < PlyType::Float32; }

std::size_t PlyElement::find(std::string_view property) const {
  const auto found =
      std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) { return p.name == property; });
  return static_cast<std::size_t>(found - properties.begin());
}

std::size_t PlyElement::smallestBytes(bool binary) const {
  // In text, a digit and what parts it from the next one; an empty list is its length alone.
  if (!binary) return 2 * properties.size();
  std::size_t bytes = 0;
  for (const PlyProperty& p : properties) bytes += sizeBytes(p.isList ? p.countType : p.type);
  return bytes;
}

PlyHeader readPlyHeader(const Source& source) {
  TextCursor cursor(source);
  PlyHeader header;
  bool hasFormat = false;
  if (cursor.token() != "ply" || !cursor.atLineEnd()) cursor.fail("the first line should be ply");
  for (;;) {
    const std::string_view keyword = cursor.token();
    if (keyword == "end_header") break;
    if (keyword == "format") {
      header.encoding = readEncoding(cursor);
      hasFormat = true;
    } else if (keyword == "element") {
      header.elements.push_back(readElement(cursor));
    } else if (keyword == "property") {
      if (header.elements.empty()) cursor.fail("a property before any element");
      header.elements.back().properties.push_back(readProperty(cursor));
    } else if (keyword.empty()) {
      cursor.fail("truncated: the file ends before end_header");
    } else if (keyword != "comment" && keyword != "obj_info") {
      cursor.fail("{} is no PLY keyword", quoted(keyword));
    }
    cursor.skipLine();
  }
  if (!hasFormat) cursor.fail("the header names no format");
  header.bodyStart = bodyStart(source, cursor.place());
  return header;
}

}  // namespace copeel
