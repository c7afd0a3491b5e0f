// PNG through libpng. Writing is tuned for pictures that are shown once: one cheap filter and the lightest compression, for time; nothing in the
// file depends on the clock or the machine, so equal images are equal files. libpng reports errors by longjmp: the functions that set the
// jump hold no object with a destructor.
#include <png.h>
#include <zlib.h>

#include <csetjmp>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/formats/input_file.h"
#include "core/image/write_image.h"
#include "core/output_file.h"

namespace copeel {
namespace {

// Of 9 levels and 5 filters, measured at 1024 x 768 for flat facets, smooth shading and facets of 3 pixels: level 2 without a filter takes 4.5, 6.8 and
// 5.0 ms for 58, 144 and 82 KB; with "up" 6.0, 12.8 and 7.7 ms for 53, 167 and 67 KB; libpng's default 28 to 60 ms for 38, 107 and 38 KB.
constexpr int kCompressionLevel = 2;
constexpr int kFilter = PNG_FILTER_NONE;
constexpr png_uint_32 kLargestPixelCount = 1u << 29;  // that a header may claim; 16384 x 16384 fits

// What a libpng callback may reach: the bytes written or read so far, and the message of a failure.
struct PngStream {
  std::vector<char>* output = nullptr;
  const char* input = nullptr;
  std::size_t inputLeft = 0;
  char message[128] = "";
};

void onError(png_structp png, png_const_charp message) {
  auto* stream = static_cast<PngStream*>(png_get_error_ptr(png));
  std::strncpy(stream->message, message, sizeof stream->message - 1);
  png_longjmp(png, 1);
}

void onWarning(png_structp, png_const_charp) {}

// The output's capacity is reserved beforehand; should it have to grow and fail, no C++ exception may cross libpng's C frames.
void appendBytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto* stream = static_cast<PngStream*>(png_get_io_ptr(png));
  bool done = true;
  try {
    stream->output->insert(stream->output->end(), bytes, bytes + count);
  } catch (...) {
    done = false;
  }
  if (!done) png_error(png, "not enough memory");
}

void takeBytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto* stream = static_cast<PngStream*>(png_get_io_ptr(png));
  if (count > stream->inputLeft) png_error(png, "truncated");
  std::memcpy(bytes, stream->input, count);
  stream->input += count;
  stream->inputLeft -= count;
}

// False on failure, with the cause in the stream.
bool encode(PngStream& stream, const Image<Rgb8>& image) {
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &stream, onError, onWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_write_struct(&png, &info);
    return false;
  }
  png_set_write_fn(png, &stream, appendBytes, nullptr);
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_IHDR(png, info, image.width, image.height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_filter(png, PNG_FILTER_TYPE_BASE, kFilter);
  png_set_compression_level(png, kCompressionLevel);
  png_set_compression_strategy(png, Z_DEFAULT_STRATEGY);
  png_set_compression_buffer_size(png, 1 << 16);
  png_write_info(png, info);
  for (int y = 0; y < image.height; ++y) png_write_row(png, &image.at(0, y).r);
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  return true;
}

// Every 8-bit (or smaller) kind becomes RGB; alpha is left out, colours keep their stored values whatever gamma the file claims.
void requestRgb(png_structp png, png_infop info) {
  const int kind = png_get_color_type(png, info);
  if (png_get_bit_depth(png, info) == 16) png_error(png, "16-bit samples");
  if (kind == PNG_COLOR_TYPE_PALETTE) png_set_palette_to_rgb(png);
  if (kind == PNG_COLOR_TYPE_GRAY && png_get_bit_depth(png, info) < 8) png_set_expand_gray_1_2_4_to_8(png);
  if (!(kind & PNG_COLOR_MASK_COLOR)) png_set_gray_to_rgb(png);
  png_set_strip_alpha(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
}

bool decode(PngStream& stream, Image<Rgb8>& image, std::vector<png_bytep>& rows) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &stream, onError, onWarning);
  png_infop info = png ? png_create_info_struct(png) : nullptr;
  if (!info || setjmp(png_jmpbuf(png))) {
    png_destroy_read_struct(&png, &info, nullptr);
    return false;
  }
  png_set_read_fn(png, &stream, takeBytes);
  png_read_info(png, info);
  requestRgb(png, info);
  if (png_get_image_width(png, info) > kLargestPixelCount / png_get_image_height(png, info))
    png_error(png, "too large");
  image =
      Image<Rgb8>(static_cast<int>(png_get_image_width(png, info)), static_cast<int>(png_get_image_height(png, info)));
  rows.resize(image.height);
  for (int y = 0; y < image.height; ++y) rows[y] = &image.at(0, y).r;
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  png_destroy_read_struct(&png, &info, nullptr);
  return true;
}

}  // namespace

void writePng(const std::string& path, const Image<Rgb8>& image) {
  static_assert(sizeof(Rgb8) == 3, "rows are handed to libpng as they are");
  OutputFile file(path);
  std::vector<char> bytes;
  bytes.reserve(image.pixels.size() + 4096);
  PngStream stream{.output = &bytes};
  if (!encode(stream, image)) failMachine("{}: cannot write: {}", path, stream.message);
  file.write(std::as_bytes(std::span(bytes)));
  file.commit();
}

Image<Rgb8> readPng(const std::string& path) {
  const InputFile file(path);
  PngStream stream{.input = file.source().data(), .inputLeft = file.source().size()};
  Image<Rgb8> image;
  std::vector<png_bytep> rows;
  if (!decode(stream, image, rows)) failInput("{}: not a PNG image that can be read: {}", path, stream.message);
  return image;
}

}  // namespace copeel
