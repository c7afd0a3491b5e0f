// What a PLY file says of itself before its data: the encoding, and the elements with their properties in the order in which they are stored.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/formats/input_file.h"

namespace copeel {

enum class PlyType : std::uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };
std::size_t sizeBytes(PlyType type);
bool isInteger(PlyType type);

struct PlyProperty {
  std::string_view name;
  PlyType type = PlyType::Float32;
  bool isList = false;
  PlyType countType = PlyType::Uint8;  // of a list's length
};

struct PlyElement {
  std::string_view name;
  std::uint64_t count = 0;  // as the file claims; not to be trusted with memory
  std::vector<PlyProperty> properties;

  // The index of a property; properties.size() where there is none.
  std::size_t find(std::string_view property) const;
  std::size_t smallestBytes(bool binary) const;  // that one of them can take
};

struct PlyHeader {
  enum class Encoding { Ascii, LittleEndian, BigEndian };
  Encoding encoding = Encoding::Ascii;
  std::vector<PlyElement> elements;
  std::size_t bodyStart = 0;  // byte
};

PlyHeader readPlyHeader(const Source& source);

}  // namespace copeel
