// Image files, written whole or not at all: a temporary file beside the target, renamed at the end.
// Throws Error{Machine} naming the file and the cause (no permission, disk full …).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/image/image.h"

namespace copeel {

// A PNG file in parts, one after the other: 8-bit RGB, or indexed where 256 colours are enough.
using Bytes = std::vector<std::uint8_t>;
std::vector<Bytes> encodePng(const Image<Rgb8>& image);
void writePng(const std::string& path, const Image<Rgb8>& image);
void writePfm(const std::string& path, const Image<float>& image);               // float32, little-endian, bottom row first, +inf kept
void writePgm(const std::string& path, const Image<std::uint16_t>& image);       // 16-bit binary, big-endian as PGM says

// For tests and comparisons; throws Error{Input} on anything but what the functions above write or openscad exports.
Image<Rgb8> readPng(const std::string& path);
Image<float> readPfm(const std::string& path);

}  // namespace copeel
