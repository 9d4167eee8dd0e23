#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace quadloop::io {

/// A PNG picture that is written row by row, from the top, so that its pixels are never in memory together.
class PngRows {
 public:
  PngRows(int width, int height);
  ~PngRows();
  PngRows(const PngRows&) = delete;
  PngRows& operator=(const PngRows&) = delete;

  /// Appends a row of pixels, each with 8 bits of red, green and blue below 8 unused bits. Throws a Fault if
  /// libpng fails.
  void append(std::span<const std::uint32_t> pixels);

  /// Returns the bytes of the file, after the last row. Throws a Fault if libpng fails.
  std::string finish();

 private:
  struct Writer;
  std::unique_ptr<Writer> writer_;
};

}  // namespace quadloop::io
