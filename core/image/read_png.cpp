// PNG through libpng. It reports errors by longjmp: the function that sets the jump holds no object with a destructor.
#include <png.h>

#include <csetjmp>
#include <cstring>
#include <string>
#include <vector>

#include "core/error.h"
#include "core/formats/input_file.h"
#include "core/image/write_image.h"

namespace copeel {
namespace {

constexpr png_uint_32 kLargestPixelCount = 1u << 29;  // that a header may claim; 16384 x 16384 fits

// What a libpng callback may reach: the bytes still to be read, and the message of a failure.
struct PngStream {
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

void takeBytes(png_structp png, png_bytep bytes, std::size_t count) {
  auto* stream = static_cast<PngStream*>(png_get_io_ptr(png));
  if (count > stream->inputLeft) png_error(png, "truncated");
  std::memcpy(bytes, stream->input, count);
  stream->input += count;
  stream->inputLeft -= count;
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

// False on failure, with the cause in the stream.
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

Image<Rgb8> readPng(const std::string& path) {
  const InputFile file(path);
  PngStream stream{.input = file.source().data(), .inputLeft = file.source().size()};
  Image<Rgb8> image;
  std::vector<png_bytep> rows;
  if (!decode(stream, image, rows)) failInput("{}: not a PNG image that can be read: {}", path, stream.message);
  return image;
}

}  // namespace copeel
