// Images survive writing and reading; their bytes are what the formats and the design say.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <limits>

#include "core/error.h"
#include "core/image/write_image.h"
#include "core/parallel.h"
#include "tests/temporary_folder.h"

namespace copeel {
namespace {

std::string contentOf(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Image<Rgb8> gradient(int width, int height) {
  Image<Rgb8> image(width, height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      image.at(x, y) = {static_cast<std::uint8_t>(x / 4), static_cast<std::uint8_t>(y / 4),
                        static_cast<std::uint8_t>((x / 64) ^ (y / 64))};
    }
  }
  return image;
}

TEST(Png, survivesAndIsDeterministic) {
  const TemporaryFolder folder;
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(7, 3), std::pair(300, 200), std::pair(16384, 1), std::pair(1, 16384)}) {
    const Image<Rgb8> image = gradient(width, height);
    writePng(folder.file("a.png"), image);
    writePng(folder.file("b.png"), image);
    const Image<Rgb8> read = readPng(folder.file("a.png"));
    EXPECT_EQ(read.width, width);
    EXPECT_EQ(read.height, height);
    EXPECT_EQ(read.pixels, image.pixels);
    EXPECT_EQ(contentOf(folder.file("a.png")), contentOf(folder.file("b.png")));
  }
}

Image<Rgb8> withColors(int count, int width, int height) {
  Image<Rgb8> image(width, height);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const auto color = static_cast<std::uint32_t>(i * i / 977 % static_cast<std::size_t>(count)) * 0x010307u;
    image.pixels[i] = {static_cast<std::uint8_t>(color >> 16), static_cast<std::uint8_t>(color >> 8), static_cast<std::uint8_t>(color)};
  }
  return image;
}

TEST(Png, paletteAndStripsKeepEveryPixelWhateverTheThreads) {
  const TemporaryFolder folder;
  constexpr char kRgb = 2, kIndexed = 3;
  for (const auto& [count, kind] : {std::pair(1, kIndexed), std::pair(2, kIndexed), std::pair(256, kIndexed), std::pair(257, kRgb), std::pair(5000, kRgb)}) {
    // The smaller picture is one strip, the larger one nine, the last of them short.
    for (const auto& [width, height] : {std::pair(641, 97), std::pair(1031, 1009)}) {
      const Image<Rgb8> image = withColors(count, width, height);
      Threads(1).execute([&] { writePng(folder.file("1.png"), image); });
      Threads(3).execute([&] { writePng(folder.file("3.png"), image); });
      const std::string content = contentOf(folder.file("1.png"));
      EXPECT_EQ(content.at(25), kind) << count;
      EXPECT_TRUE(content == contentOf(folder.file("3.png"))) << count;
      EXPECT_TRUE(readPng(folder.file("1.png")).pixels == image.pixels) << count;
    }
  }
}

TEST(Png, everyTruncationIsRefused) {
  const TemporaryFolder folder;
  writePng(folder.file("a.png"), gradient(9, 9));
  const std::string whole = contentOf(folder.file("a.png"));
  for (std::size_t size = 0; size < whole.size(); ++size) {
    EXPECT_THROW(readPng(folder.write("cut.png", whole.substr(0, size))), Error) << size;
  }
}

TEST(Pfm, keepsInfinityAndRunsFromTheBottom) {
  const TemporaryFolder folder;
  Image<float> image(2, 2);
  image.at(0, 0) = 1, image.at(1, 0) = 2, image.at(0, 1) = std::numeric_limits<float>::infinity(), image.at(1, 1) = 1e-40f;
  writePfm(folder.file("a.pfm"), image);
  const std::string content = contentOf(folder.file("a.pfm"));
  EXPECT_EQ(content.substr(0, 12), "Pf\n2 2\n-1.0\n");
  EXPECT_EQ(content.size(), 12u + 16u);
  EXPECT_EQ(content.substr(12, 4), std::string("\0\0\x80\x7f", 4)) << "the first sample is the lower left one";
  EXPECT_EQ(readPfm(folder.file("a.pfm")).pixels, image.pixels);
  EXPECT_THROW(readPfm(folder.write("cut.pfm", content.substr(0, content.size() - 1))), Error);
  EXPECT_EQ(readPfm(folder.write("big.pfm", std::string("Pf\n1 1\n1.0\n\x3f\x80\0\0", 15))).at(0, 0), 1.0f);
}

TEST(Pgm, isSixteenBitBigEndianFromTheTop) {
  const TemporaryFolder folder;
  Image<std::uint16_t> image(2, 1);
  image.at(0, 0) = 0x0102, image.at(1, 0) = 0xfffe;
  writePgm(folder.file("a.pgm"), image);
  EXPECT_EQ(contentOf(folder.file("a.pgm")), std::string("P5\n2 1\n65535\n\x01\x02\xff\xfe"));
}

}  // namespace
}  // namespace copeel
