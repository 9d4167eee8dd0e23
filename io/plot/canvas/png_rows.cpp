#include "io/plot/canvas/png_rows.hpp"

#include <png.h>

#include <csetjmp>
#include <new>
#include <vector>

#include "mesher/base/error.hpp"

namespace quadloop::io {

struct PngRows::Writer {
  ~Writer();

  png_structp png = nullptr;
  png_infop info = nullptr;
  std::string bytes;
  std::vector<png_byte> row;  ///< red, green and blue of each pixel
};

namespace {

/// Neither an exception nor the end of the program may come from libpng, which is C.
void append_bytes(png_structp png, png_bytep data, std::size_t count) noexcept {
  bool is_appended = true;
  try {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(data), count);
  } catch (...) {
    is_appended = false;
  }
  if (!is_appended) png_error(png, "no memory");
}

void no_flush(png_structp /*png*/) noexcept {}
[[noreturn]] void on_error(png_structp png, png_const_charp /*message*/) { png_longjmp(png, 1); }
void on_warning(png_structp /*png*/, png_const_charp /*message*/) noexcept {}

/// Calls libpng. No object with a destructor may be created in `call`, as libpng leaves it by longjmp if it
/// fails.
template <class Call>
void call_png(png_structp png, const Call& call) {
  if (setjmp(png_jmpbuf(png)) != 0) throw Fault("the picture could not be compressed");
  call();
}

}  // namespace

PngRows::Writer::~Writer() { png_destroy_write_struct(&png, &info); }

PngRows::PngRows(int width, int height) : writer_{std::make_unique<Writer>()} {
  Writer& w = *writer_;
  w.row.resize(3 * static_cast<std::size_t>(width));
  w.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, on_error, on_warning);
  if (w.png != nullptr) w.info = png_create_info_struct(w.png);
  if (w.info == nullptr) throw std::bad_alloc();
  call_png(w.png, [&] {
    png_set_write_fn(w.png, &w.bytes, append_bytes, no_flush);
    png_set_IHDR(w.png, w.info, width, height, 8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_write_info(w.png, w.info);
  });
}

PngRows::~PngRows() = default;

void PngRows::append(std::span<const std::uint32_t> pixels) {
  Writer& w = *writer_;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    for (std::size_t channel = 0; channel < 3; ++channel)
      w.row[3 * i + channel] = static_cast<png_byte>(pixels[i] >> (16 - 8 * channel) & 0xffU);
  }
  call_png(w.png, [&] { png_write_row(w.png, w.row.data()); });
}

std::string PngRows::finish() {
  call_png(writer_->png, [&] { png_write_end(writer_->png, writer_->info); });
  return std::move(writer_->bytes);
}

}  // namespace quadloop::io
