// Short ways to make a mesh of text and to learn what a reader says of bad text.
#pragma once

#include <cstring>
#include <string>
#include <string_view>

#include "core/error.h"
#include "core/formats/read_mesh.h"

inline copeel::Mesh meshOf(std::string_view text) { return copeel::readMeshFromMemory(text, "m"); }

// The one line of an Error{Input}; the empty string when the text is read.
inline std::string faultOf(std::string_view text) {
  try {
    meshOf(text);
    return "";
  } catch (const copeel::Error& error) {
    if (error.code() != copeel::ExitCode::Input) return "wrong exit code: " + std::string(error.what());
    return error.what();
  }
}

// The bytes of a value, least significant first or last.
template <class T>
std::string bytesOf(T value, bool bigEndian = false) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bigEndian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}
