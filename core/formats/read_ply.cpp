// PLY: the header says how values lie; vertices (x, y, z), faces (vertex_indices or vertex_index), triangle strips and, where wanted, the colours of
// both (red, green, blue, alpha, or with diffuse_ before them) are taken, all other elements and properties are passed over. One reader for all encodings, over a source of values that is either text or bytes.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <glm/vec4.hpp>

#include "core/formats/ply_header.h"
#include "core/formats/readers.h"
#include "core/formats/soup_builder.h"
#include "core/formats/text_cursor.h"

namespace copeel {
namespace {

static_assert(std::endian::native == std::endian::little, "little-endian values are read as they lie in memory");

// Which channel (0 … 3 for red, green, blue, alpha) each property of an element holds, and kNoChannel for the others.
class ColorChannels {
 public:
  static constexpr int kNoChannel = -1;

  ColorChannels(const PlyElement& element, bool wanted) : element_(element), channels_(element.properties.size(), kNoChannel) {
    if (!wanted) return;
    for (const std::string prefix : {"", "diffuse_"}) {
      if (any_) break;
      const std::array<std::size_t, 4> at = {element.find(prefix + "red"), element.find(prefix + "green"), element.find(prefix + "blue"),
                                             element.find(prefix.empty() ? "alpha" : prefix + "alpha")};
      const auto isNumber = [&](std::size_t i) { return i < element.properties.size() && !element.properties[i].isList; };
      if (!isNumber(at[0]) || !isNumber(at[1]) || !isNumber(at[2])) continue;
      any_ = true;
      for (int c = 0; c < 4; ++c) {
        if (isNumber(at[c])) channels_[at[c]] = c;
      }
    }
  }

  bool any() const { return any_; }
  int of(std::size_t property) const { return channels_[property]; }
  // Whole numbers fill the range of their type, others run from 0 to 1.
  void store(std::size_t property, double value, glm::vec4& color) const {
    const PlyType type = element_.properties[property].type;
    const double full = isInteger(type) ? std::exp2(8.0 * sizeBytes(type) - isSigned(type)) - 1 : 1;
    const double share = value > 0 ? std::min(value / full, 1.0) : 0.0;   // not a number is 0
    const int channel = channels_[property];
    color[channel] = static_cast<float>(channel < 3 ? 255 * share : share);
  }

 private:
  static bool isSigned(PlyType type) { return type == PlyType::Int8 || type == PlyType::Int16 || type == PlyType::Int32; }

  const PlyElement& element_;
  std::vector<int> channels_;
  bool any_ = false;
};

class AsciiValues {
 public:
  AsciiValues(const Source& source, std::size_t start) : cursor_(source, start) {}

  // Of the next value, which may stand on a later line than the last one.
  std::size_t place() {
    cursor_.atEnd();
    return cursor_.place();
  }
  double coordinate(PlyType) { return cursor_.number("a coordinate"); }
  double color(PlyType) { return cursor_.number("a colour"); }
  std::int64_t integer(PlyType) { return cursor_.integer("an integer"); }
  void skip(PlyType, std::uint64_t count) {
    for (; count > 0; --count) {
      if (cursor_.token().empty()) cursor_.fail("truncated: the file ends where a value should be");
    }
  }
  void expectEnd() {
    if (!cursor_.atEnd()) fail("the file should end here by its counts, found {}", quoted(cursor_.token()));
  }
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    cursor_.fail(format, std::forward<Args>(args)...);
  }

 private:
  TextCursor cursor_;
};

template <bool bigEndian>
class BinaryValues {
 public:
  BinaryValues(const Source& source, std::size_t start) : source_(source), at_(start) {}

  std::size_t place() const { return at_; }
  double coordinate(PlyType type) {
    const double value = number(type);
    if (!std::isfinite(value))
      source_.failAtByte(at_ - sizeBytes(type), "a coordinate is not a finite number: {}", value);
    return value;
  }
  double color(PlyType type) { return number(type); }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::Int8:
        return take<std::int8_t>();
      case PlyType::Uint8:
        return take<std::uint8_t>();
      case PlyType::Int16:
        return take<std::int16_t>();
      case PlyType::Uint16:
        return take<std::uint16_t>();
      case PlyType::Int32:
        return take<std::int32_t>();
      case PlyType::Uint32:
        return take<std::uint32_t>();
      default:
        fail("an integer should be here");
    }
  }
  void skip(PlyType type, std::uint64_t count) {
    if (count > (source_.size() - at_) / sizeBytes(type)) failTruncated();
    at_ += count * sizeBytes(type);
  }
  // Blanks and line ends at the end are harmless; some writers add them.
  void expectEnd() {
    for (; at_ < source_.size(); ++at_) {
      if (std::string_view(" \t\r\n").find(source_.data()[at_]) == std::string_view::npos) fail("more bytes follow the elements of the header");
    }
  }
  template <class... Args>
  [[noreturn]] void fail(fmt::format_string<Args...> format, Args&&... args) const {
    source_.failAtByte(at_, format, std::forward<Args>(args)...);
  }

 private:
  double number(PlyType type) {
    if (type == PlyType::Float32) return take<float>();
    if (type == PlyType::Float64) return take<double>();
    return static_cast<double>(integer(type));
  }
  template <class T>
  T take() {
    if (source_.size() - at_ < sizeof(T)) failTruncated();
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), source_.data() + at_, sizeof(T));
    if constexpr (bigEndian) std::reverse(bytes.begin(), bytes.end());
    at_ += sizeof(T);
    return std::bit_cast<T>(bytes);
  }
  [[noreturn]] void failTruncated() const {
    source_.failAtByte(source_.size(), "truncated: the elements of the header need more bytes");
  }

  const Source& source_;
  std::size_t at_;
};

template <class Values>
class PlyBody {
 public:
  PlyBody(const Source& source, const PlyHeader& header, SoupBuilder::Place kind, bool wantsColors)
      : header_(header), wantsColors_(wantsColors), builder_(source, kind), values_(source, header.bodyStart), sourceBytes_(source.size()) {}

  Mesh read() {
    builder_.reserve(possibleCount("vertex"), possibleCount("face"));
    for (const PlyElement& element : header_.elements) {
      // A claim of 2^40 elements without a property must not be counted through.
      if (element.count == 0 || element.properties.empty()) continue;
      if (element.name == "vertex") {
        readVertices(element);
      } else if (element.name == "face" || element.name == "tristrips") {
        readFaces(element);
      } else {
        for (std::uint64_t i = 0; i < element.count; ++i) skipAll(element.properties);
      }
    }
    values_.expectEnd();
    return builder_.finish();
  }

 private:
  // The header's count, or what the file could hold of it at most.
  std::size_t possibleCount(std::string_view name) const {
    std::size_t count = 0, bytesLeft = sourceBytes_;
    for (const PlyElement& e : header_.elements) {
      const std::size_t bytes = e.smallestBytes(header_.encoding != PlyHeader::Encoding::Ascii);
      if (e.name != name || bytes == 0) continue;
      const std::uint64_t some = std::min<std::uint64_t>(e.count, bytesLeft / bytes);
      count += some;
      bytesLeft -= some * bytes;
    }
    return count;
  }

  void readVertices(const PlyElement& element) {
    // Which axis each property fills; 3 for those passed over.
    std::vector<int> axes(element.properties.size(), 3);
    const std::array<std::string_view, 3> names = {"x", "y", "z"};
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = element.find(names[axis]);
      if (at == axes.size() || element.properties[at].isList)
        values_.fail("the vertices have no number {}", names[axis]);
      axes[at] = axis;
      if (element.properties[at].type == PlyType::Float32) builder_.setSinglePrecision();
    }
    const ColorChannels channels(element, wantsColors_);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      glm::dvec4 position(0);
      glm::vec4 color(Mesh::kNotGiven);
      for (std::size_t k = 0; k < axes.size(); ++k) {
        if (axes[k] < 3) {
          position[axes[k]] = values_.coordinate(element.properties[k].type);
        } else {
          skipOrStore(element, k, channels, color);
        }
      }
      builder_.addVertex(glm::dvec3(position));
      if (channels.any()) builder_.addVertexColor(color);
    }
  }

  void readFaces(const PlyElement& element) {
    const std::span<const PlyProperty> all = element.properties;
    const std::size_t at = std::min(element.find("vertex_indices"), element.find("vertex_index"));
    if (at == all.size() || !all[at].isList || !isInteger(all[at].type))
      values_.fail("the faces have no list of vertex indices");
    const bool strips = element.name == "tristrips";
    const ColorChannels channels(element, wantsColors_);
    for (std::uint64_t i = 0; i < element.count; ++i) {
      glm::vec4 color(Mesh::kNotGiven);
      for (std::size_t k = 0; k < at; ++k) skipOrStore(element, k, channels, color);
      const std::size_t place = values_.place();
      readList(all[at]);
      // A face is added when all its properties are known.
      for (std::size_t k = at + 1; k < all.size(); ++k) skipOrStore(element, k, channels, color);
      if (channels.any()) builder_.setFaceColor(color);
      strips ? addStrips(place) : addFace(place);
    }
  }

  // The list grows with what is read: its length is only a claim.
  void readList(const PlyProperty& property) {
    const std::int64_t count = values_.integer(property.countType);
    if (count < 0) values_.fail("a list of {} values", count);
    list_.clear();
    for (std::int64_t i = 0; i < count; ++i) list_.push_back(values_.integer(property.type));
  }

  void addFace(std::size_t place) {
    corners_.clear();
    for (const std::int64_t value : list_) corners_.push_back(builder_.index(value, place));
    builder_.addFace(corners_, place);
  }

  // -1 parts strips; every second triangle of a strip is turned around to keep the strip's orientation.
  void addStrips(std::size_t place) {
    std::size_t start = 0;
    for (std::size_t i = 0; i < list_.size(); ++i) {
      if (list_[i] == -1) start = i + 1;
      if (i < start + 2) continue;
      std::array<std::uint32_t, 3> corners = {builder_.index(list_[i - 2], place), builder_.index(list_[i - 1], place),
                                              builder_.index(list_[i], place)};
      if ((i - start) % 2 == 1) std::swap(corners[0], corners[1]);
      builder_.addFace(corners, place);
    }
  }

  void skipAll(std::span<const PlyProperty> properties) {
    for (const PlyProperty& property : properties) skip(property);
  }

  void skipOrStore(const PlyElement& element, std::size_t k, const ColorChannels& channels, glm::vec4& color) {
    if (channels.of(k) == ColorChannels::kNoChannel) skip(element.properties[k]);
    else channels.store(k, values_.color(element.properties[k].type), color);
  }

  void skip(const PlyProperty& property) {
    const std::int64_t count = property.isList ? values_.integer(property.countType) : 1;
    if (count < 0) values_.fail("a list of {} values", count);
    values_.skip(property.type, static_cast<std::uint64_t>(count));
  }

  const PlyHeader& header_;
  bool wantsColors_;
  SoupBuilder builder_;
  Values values_;
  std::size_t sourceBytes_;
  std::vector<std::int64_t> list_;
  std::vector<std::uint32_t> corners_;
};

}  // namespace

bool looksLikePly(const Source& source) { return TextCursor(source).token() == "ply"; }

Mesh readPly(const Source& source, const ReadMeshOptions& options) {
  const PlyHeader header = readPlyHeader(source);
  switch (header.encoding) {
    case PlyHeader::Encoding::LittleEndian:
      return PlyBody<BinaryValues<false>>(source, header, SoupBuilder::Place::Byte, options.colors).read();
    case PlyHeader::Encoding::BigEndian:
      return PlyBody<BinaryValues<true>>(source, header, SoupBuilder::Place::Byte, options.colors).read();
    default:
      return PlyBody<AsciiValues>(source, header, SoupBuilder::Place::Line, options.colors).read();
  }
}

}  // namespace copeel
