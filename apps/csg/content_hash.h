// A name for content: equal names, equal content. Based on: Fowler, Noll, Vo. The FNV non-cryptographic hash algorithm (FNV-1a, 128 bits).
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace copeel::csg {

class ContentHash {
 public:
  void add(std::string_view bytes) {
    for (const char c : bytes) addByte(c);
    addSize(bytes.size());
  }
  // The same of the text without its white space.
  void addDense(std::string_view text) {
    std::size_t size = 0;
    for (const char c : text) {
      if (c == ' ' || c == '\t' || c == '\n' || c == '\r') continue;
      addByte(c);
      ++size;
    }
    addSize(size);
  }
  std::string hex() const { return fmt::format("{:016x}{:016x}", static_cast<std::uint64_t>(state_ >> 64), static_cast<std::uint64_t>(state_)); }

 private:
  using Wide = unsigned __int128;
  static constexpr Wide kPrime = (Wide(1) << 88) + 0x13B;

  void addByte(char c) { state_ = (state_ ^ static_cast<unsigned char>(c)) * kPrime; }
  void addSize(std::size_t size) { state_ = (state_ ^ size) * kPrime; }   // so that "ab", "c" is not "a", "bc"

  Wide state_ = (Wide(0x6C62272E07BB0142u) << 64) | 0x62B821756295C58Du;
};

}  // namespace copeel::csg
