#include "io/plot/canvas/png_rows.hpp"

#include <gtest/gtest.h>
#include <png.h>

#include <array>
#include <cstdint>
#include <vector>

#include "mesher/base/error.hpp"

namespace quadloop::io {
namespace {

constexpr int width = 3, height = 2;
constexpr std::array<std::uint32_t, 6> pixels{0xff102030U, 0x00ffffffU, 0xff000000U,
                                              0x12010203U, 0xfffefdfcU, 0xff00ff00U};

std::string written() {
  PngRows rows(width, height);
  for (int y = 0; y < height; ++y) rows.append(std::span(pixels).subspan(width * y, width));
  return rows.finish();
}

TEST(PngRows, AReaderFindsThePixelsWithoutTheirUnusedBits) {
  const std::string bytes = written();
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  ASSERT_NE(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()), 0);
  EXPECT_EQ(image.width, static_cast<unsigned>(width));
  EXPECT_EQ(image.height, static_cast<unsigned>(height));
  image.format = PNG_FORMAT_RGB;
  std::vector<std::uint8_t> found(PNG_IMAGE_SIZE(image));
  ASSERT_NE(png_image_finish_read(&image, nullptr, found.data(), 0, nullptr), 0);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    EXPECT_EQ(found[3 * i], pixels[i] >> 16U & 0xffU);
    EXPECT_EQ(found[3 * i + 1], pixels[i] >> 8U & 0xffU);
    EXPECT_EQ(found[3 * i + 2], pixels[i] & 0xffU);
  }
}

TEST(PngRows, AFileWithoutItsLastRowIsAFault) {
  PngRows rows(width, height);
  rows.append(std::span(pixels).first(width));
  EXPECT_THROW(rows.finish(), Fault);
}

}  // namespace
}  // namespace quadloop::io
