// PFM (float32, one channel) and PGM (16 bit) files: a line or three of text, then raw samples. PFM runs from the bottom row to the top,
// and the sign of its scale gives the byte order; PGM runs from the top, most significant byte first.
#include <bit>
#include <cstring>
#include <string>

#include "core/error.h"
#include "core/formats/input_file.h"
#include "core/formats/text_cursor.h"
#include "core/image/write_image.h"
#include "core/output_file.h"

namespace copeel {
namespace {

static_assert(std::endian::native == std::endian::little, "samples are written and read as they lie in memory");

constexpr int kLargestSide = 1 << 20;  // pixels; keeps width · height · sample far from overflow

int readSide(TextCursor& cursor) {
  const std::int64_t side = cursor.integer("an image size");
  if (side < 1 || side > kLargestSide) cursor.fail("an image size of {} pixels", side);
  return static_cast<int>(side);
}

}  // namespace

void writePfm(const std::string& path, const Image<float>& image) {
  OutputFile file(path);
  std::string bytes = fmt::format("Pf\n{} {}\n-1.0\n", image.width, image.height);
  const std::size_t headerBytes = bytes.size(), rowBytes = sizeof(float) * image.width;
  bytes.resize(headerBytes + rowBytes * image.height);
  if (!image.pixels.empty()) {
    for (int y = 0; y < image.height; ++y) {
      std::memcpy(&bytes[headerBytes + rowBytes * (image.height - 1 - y)], &image.at(0, y), rowBytes);
    }
  }
  file.write(bytes);
  file.commit();
}

void writePgm(const std::string& path, const Image<std::uint16_t>& image) {
  OutputFile file(path);
  std::string bytes = fmt::format("P5\n{} {}\n65535\n", image.width, image.height);
  std::size_t at = bytes.size();
  bytes.resize(at + 2 * image.pixels.size());
  for (const std::uint16_t value : image.pixels) {
    bytes[at++] = static_cast<char>(value >> 8);
    bytes[at++] = static_cast<char>(value & 0xff);
  }
  file.write(bytes);
  file.commit();
}

Image<float> readPfm(const std::string& path) {
  const InputFile file(path);
  const Source source = file.source();
  TextCursor cursor(source);
  if (cursor.token() != "Pf") source.fail("not a one-channel PFM image");
  const int width = readSide(cursor), height = readSide(cursor);
  const double scale = cursor.number("the scale");
  if (scale == 0) cursor.fail("the scale is zero");
  // One white-space byte ends the header; the samples follow.
  const std::size_t start = cursor.place() + 1, rowBytes = sizeof(float) * width;
  if (start > source.size() || source.size() - start < rowBytes * height) {
    source.failAtByte(source.size(), "truncated: {} x {} pixels need {} bytes of samples", width, height,
                      rowBytes * height);
  }
  Image<float> image(width, height);
  for (int y = 0; y < height; ++y) {
    std::memcpy(&image.at(0, height - 1 - y), source.data() + start + rowBytes * y, rowBytes);
  }
  if (scale > 0) {
    for (float& value : image.pixels)
      value = std::bit_cast<float>(__builtin_bswap32(std::bit_cast<std::uint32_t>(value)));
  }
  return image;
}

}  // namespace copeel
