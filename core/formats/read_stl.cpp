// STL: a soup of triangles, each written with its own three vertices. Binary when the size is what the count at byte 80 demands, whatever the first
// bytes say (some writers begin a binary header with "solid"). Normals and attributes are passed over: the corners decide.
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "core/formats/readers.h"
#include "core/formats/soup_builder.h"
#include "core/formats/text_cursor.h"

namespace copeel {
namespace {

static_assert(std::endian::native == std::endian::little, "binary STL is read as it lies in memory");

constexpr std::size_t kHeaderBytes = 84, kCountAt = 80, kTriangleBytes = 50, kNormalBytes = 12;
constexpr std::size_t kSmallestFacetBytes = 60;  // "facet normal … endfacet" in ascii

std::uint64_t binarySize(const Source& source) {
  std::uint32_t count = 0;
  std::memcpy(&count, source.data() + kCountAt, sizeof count);
  return kHeaderBytes + std::uint64_t{count} * kTriangleBytes;
}

bool isExactlyBinary(const Source& source) {
  return source.size() >= kHeaderBytes && binarySize(source) == source.size();
}

// Text has no zero bytes; a binary header or its count nearly always has.
bool hasZeroByte(const Source& source) {
  return source.size() > 0 &&
         std::memchr(source.data(), 0, std::min(source.size(), kHeaderBytes + kTriangleBytes)) != nullptr;
}

bool sameWord(std::string_view token, std::string_view lower) {
  return std::equal(token.begin(), token.end(), lower.begin(), lower.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

Mesh readBinary(const Source& source) {
  if (source.size() < kHeaderBytes) source.failAtByte(source.size(), "truncated in the header of a binary STL");
  const std::uint64_t expected = binarySize(source);
  const std::uint64_t count = (expected - kHeaderBytes) / kTriangleBytes;
  if (source.size() < expected)
    source.failAtByte(source.size(), "truncated: {} triangles need {} bytes", count, expected);
  if (source.size() > expected) source.failAtByte(expected, "more bytes follow the {} triangles of the header", count);
  SoupBuilder builder(source, SoupBuilder::Place::Byte);
  builder.setSinglePrecision();
  builder.reserve(3 * count, count);
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::size_t place = kHeaderBytes + i * kTriangleBytes + kNormalBytes;
    float c[9];
    std::memcpy(c, source.data() + place, sizeof c);
    for (int k = 0; k < 9; ++k) {
      if (!std::isfinite(c[k])) source.failAtByte(place + 4 * k, "a coordinate is not a finite number: {}", c[k]);
    }
    std::array<std::uint32_t, 3> corners;
    for (int k = 0; k < 3; ++k) corners[k] = builder.sharedVertex({c[3 * k], c[3 * k + 1], c[3 * k + 2]}, place);
    builder.addFace(corners, place);
  }
  return builder.finish();
}

class AsciiStl {
 public:
  explicit AsciiStl(const Source& source) : cursor_(source), builder_(source, SoupBuilder::Place::Line) {
    builder_.reserve(3 * (source.size() / kSmallestFacetBytes), source.size() / kSmallestFacetBytes);
  }

  Mesh read() {
    // A file may hold several solids.
    do {
      expect("solid");
      cursor_.skipLine();
      readSolid();
    } while (!cursor_.atEnd());
    return builder_.finish();
  }

 private:
  void readSolid() {
    for (std::string_view word = cursor_.token(); !sameWord(word, "endsolid"); word = cursor_.token()) {
      if (word.empty()) cursor_.fail("truncated: the file ends before endsolid");
      if (!sameWord(word, "facet")) cursor_.fail("facet or endsolid should be here, found {}", quoted(word));
      readFacet();
    }
    cursor_.skipLine();
  }

  void readFacet() {
    const std::size_t place = cursor_.place();
    cursor_.skipLine();
    expect("outer");
    expect("loop");
    corners_.clear();
    for (std::string_view word = cursor_.token(); !sameWord(word, "endloop"); word = cursor_.token()) {
      if (!sameWord(word, "vertex")) cursor_.fail("vertex or endloop should be here, found {}", quoted(word));
      corners_.push_back(builder_.sharedVertex(cursor_.point("a coordinate"), place));
    }
    expect("endfacet");
    if (corners_.size() < 3) cursor_.fail("a facet of {} vertices", corners_.size());
    builder_.addFace(corners_, place);
  }

  void expect(const char* keyword) {
    const std::string_view word = cursor_.token();
    if (word.empty()) cursor_.fail("truncated: the file ends where {} should be", keyword);
    if (!sameWord(word, keyword)) cursor_.fail("{} should be here, found {}", keyword, quoted(word));
  }

  TextCursor cursor_;
  SoupBuilder builder_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

bool looksLikeStl(const Source& source) {
  if (isExactlyBinary(source)) return true;
  return sameWord(TextCursor(source).token(), "solid");
}

Mesh readStl(const Source& source, const ReadMeshOptions&) {
  if (isExactlyBinary(source) || hasZeroByte(source)) return readBinary(source);
  return AsciiStl(source).read();
}

}  // namespace copeel
