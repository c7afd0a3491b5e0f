// OFF: [ST][C][N]OFF, three counts, a line per vertex, a line per face. Vertices begin with x y z in all variants; normals, colours and texture
// coordinates follow on the same line and are passed over, as colours are after a face's indices.
#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "core/formats/readers.h"
#include "core/formats/soup_builder.h"
#include "core/formats/text_cursor.h"

namespace copeel {
namespace {

constexpr std::size_t kSmallestVertexBytes = 6, kSmallestFaceBytes = 2;  // "0 0 0\n", "0\n"

// What follows OFF in the first token; some data sets write the vertex count there ("OFF490 518 0").
std::optional<std::string_view> afterKeyword(std::string_view token) {
  for (const std::string_view prefix : {"ST", "C", "N", "4", "n"}) {
    if (token.starts_with(prefix)) token.remove_prefix(prefix.size());
  }
  if (!token.starts_with("OFF")) return std::nullopt;
  token.remove_prefix(3);
  const bool digits = std::all_of(token.begin(), token.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits ? std::optional(token) : std::nullopt;
}

struct Counts {
  std::int64_t vertices = 0;
  std::int64_t faces = 0;
};

Counts readHeader(TextCursor& cursor) {
  const std::string_view keyword = cursor.token();
  const std::optional<std::string_view> glued = afterKeyword(keyword);
  if (!glued) cursor.fail("OFF should be here, found {}", quoted(keyword));
  if (keyword.find_first_of("4n") < keyword.find("OFF"))
    cursor.fail("vertices of other than three dimensions ({})", quoted(keyword));
  Counts counts;
  if (glued->empty()) {
    TextCursor ahead = cursor;
    if (ahead.token() == "BINARY") cursor.fail("binary OFF is not read");
    counts.vertices = cursor.integer("the number of vertices");
  } else if (!parseInteger(*glued, counts.vertices)) {
    cursor.fail("the number of vertices should be here, found {}", quoted(keyword));
  }
  counts.faces = cursor.integer("the number of faces");
  if (counts.vertices < 0 || counts.faces < 0) cursor.fail("a count is negative");
  // The number of edges means nothing and some writers leave it out.
  if (!cursor.atLineEnd()) cursor.integer("the number of edges");
  if (!cursor.atLineEnd()) cursor.fail("the line should end after the counts, found {}", quoted(cursor.lineToken()));
  return counts;
}

void readFace(TextCursor& cursor, SoupBuilder& builder, std::vector<std::uint32_t>& corners) {
  const std::int64_t count = cursor.integer("a face's number of corners");
  const std::size_t place = cursor.place();
  if (count < 0) cursor.fail("a face of {} corners", count);
  corners.clear();
  for (std::int64_t i = 0; i < count; ++i) {
    if (cursor.atLineEnd()) cursor.fail("the face has {} of its {} corners", i, count);
    corners.push_back(builder.index(cursor.integer("a vertex index"), place));
  }
  builder.addFace(corners, place);
  cursor.skipLine();
}

}  // namespace

bool looksLikeOff(const Source& source) { return afterKeyword(TextCursor(source, 0, '#').token()).has_value(); }

Mesh readOff(const Source& source, const ReadMeshOptions&) {
  TextCursor cursor(source, 0, '#');
  const Counts counts = readHeader(cursor);
  SoupBuilder builder(source, SoupBuilder::Place::Line);
  builder.reserve(std::min<std::size_t>(counts.vertices, source.size() / kSmallestVertexBytes),
                  std::min<std::size_t>(counts.faces, source.size() / kSmallestFaceBytes));
  for (std::int64_t i = 0; i < counts.vertices; ++i) {
    builder.addVertex(cursor.point("a coordinate"));
    cursor.skipLine();
  }
  std::vector<std::uint32_t> corners;
  for (std::int64_t i = 0; i < counts.faces; ++i) readFace(cursor, builder, corners);
  // What the counts leave over would be lost in silence.
  if (!cursor.atEnd()) {
    const std::string_view extra = cursor.token();
    cursor.fail("the file should end here by its counts, found {}", quoted(extra));
  }
  return builder.finish();
}

}  // namespace copeel
