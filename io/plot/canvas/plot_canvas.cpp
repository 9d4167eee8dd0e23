#include "io/plot/canvas/plot_canvas.hpp"

#include <cairo-pdf.h>
#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>
#include <numbers>
#include <optional>

#include "io/plot/canvas/png_rows.hpp"
#include "mesher/base/error.hpp"

namespace quadloop::io {

namespace {

constexpr double font_size = 16;
constexpr int pixels_of_strip = 1 << 19;

struct DestroySurface {
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
};
struct DestroyContext {
  void operator()(cairo_t* context) const { cairo_destroy(context); }
};
using Surface = std::unique_ptr<cairo_surface_t, DestroySurface>;
using Context = std::unique_ptr<cairo_t, DestroyContext>;

/// No exception may propagate through Cairo, which is C.
cairo_status_t append(void* bytes, const unsigned char* data, unsigned length) noexcept {
  try {
    static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
    return CAIRO_STATUS_SUCCESS;
  } catch (...) {
    return CAIRO_STATUS_NO_MEMORY;
  }
}

void require_success(cairo_status_t status) {
  if (status == CAIRO_STATUS_NO_MEMORY) throw std::bad_alloc();
  if (status != CAIRO_STATUS_SUCCESS)
    throw Fault(std::string("the picture could not be drawn: ") + cairo_status_to_string(status));
}

/// Of a sheet without pixels.
Surface make_vector_surface(PlotFormat format, double width, double height, std::string& bytes) {
  if (format == PlotFormat::svg)
    return Surface(cairo_svg_surface_create_for_stream(append, &bytes, width, height));
  Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, width, height));
  cairo_pdf_surface_set_metadata(surface.get(), CAIRO_PDF_METADATA_CREATE_DATE,
                                 "2000-01-01T00:00:00Z");  // for reproducible bytes
  return surface;
}

void choose_font(cairo_t* context) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, font_size);
}

/// Returns text that Cairo accepts. As rejected text would spoil the whole picture, it is tested on a scratch
/// context.
std::string printable(std::string text) {
  const Surface surface(cairo_image_surface_create(CAIRO_FORMAT_A8, 1, 1));
  const Context context(cairo_create(surface.get()));
  cairo_text_extents_t extents;
  cairo_text_extents(context.get(), text.c_str(), &extents);
  if (cairo_status(context.get()) == CAIRO_STATUS_SUCCESS) return text;
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text;
}

}  // namespace

Strips Strips::one(PlotFormat format, double width, double height, double scale) {
  Strips strips;
  strips.format_ = format;
  strips.size_ = {width, height};
  strips.scale_ = scale;
  strips.width_ = std::max(1, static_cast<int>(std::lround(scale * width)));
  strips.height_ = std::max(1, static_cast<int>(std::lround(scale * height)));
  strips.rows_ = strips.height_;
  return strips;
}

Strips::Strips(PlotFormat format, double width, double height, double scale)
    : Strips{one(format, width, height, scale)} {
  if (format == PlotFormat::png) rows_ = std::clamp(pixels_of_strip / width_, 1, height_);
}

Box Strips::part(int strip) const {
  if (count() == 1) return {{0, 0}, size_};
  const double top = strip * rows_, bottom = std::min((strip + 1) * rows_, height_);
  return {{0, top / scale_}, {size_.x, bottom / scale_}};
}

struct Canvas::Cairo {
  Strips strips;
  int strip = 0;
  std::string bytes;            ///< declared before the surface, which writes to it until its end
  std::optional<PngRows> rows;  ///< if the file has pixels
  Surface surface;
  Context context;
};

Canvas::Canvas(const Strips& strips) : cairo_{std::make_unique<Cairo>()} {
  cairo_->strips = strips;
  if (strips.format_ == PlotFormat::png) {
    cairo_->rows.emplace(strips.width_, strips.height_);
    cairo_->surface.reset(cairo_image_surface_create(CAIRO_FORMAT_RGB24, strips.width_, strips.rows_));
  } else {
    cairo_->surface = make_vector_surface(strips.format_, strips.scale_ * strips.size_.x,
                                          strips.scale_ * strips.size_.y, cairo_->bytes);
  }
  require_success(cairo_surface_status(cairo_->surface.get()));
  cairo_->context.reset(cairo_create(cairo_->surface.get()));
  begin_strip();
}

/// Makes the surface white, and gives it the coordinates of the sheet.
void Canvas::begin_strip() {
  cairo_t* context = cairo_->context.get();
  const Strips& strips = cairo_->strips;
  cairo_identity_matrix(context);
  cairo_translate(context, 0, -cairo_->strip * strips.rows_);
  cairo_scale(context, strips.scale_, strips.scale_);
  cairo_set_source_rgb(context, 1, 1, 1);
  cairo_paint(context);
  cairo_set_line_cap(context, CAIRO_LINE_CAP_ROUND);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
  choose_font(context);
}

/// Hands the pixels of this strip to the file.
void Canvas::keep_rows() {
  cairo_surface_t* surface = cairo_->surface.get();
  const Strips& strips = cairo_->strips;
  cairo_surface_flush(surface);
  const unsigned char* const data = cairo_image_surface_get_data(surface);
  const int stride = cairo_image_surface_get_stride(surface);
  const int rows = std::min(strips.rows_, strips.height_ - cairo_->strip * strips.rows_);
  for (int y = 0; y < rows; ++y) {
    const auto* row = reinterpret_cast<const std::uint32_t*>(data + static_cast<std::ptrdiff_t>(y) * stride);
    cairo_->rows->append({row, static_cast<std::size_t>(strips.width_)});
  }
}

void Canvas::next_strip() {
  require_success(cairo_status(cairo_->context.get()));
  keep_rows();
  ++cairo_->strip;
  begin_strip();
}

Canvas::~Canvas() = default;

void Canvas::clip(const Box& box) {
  cairo_t* context = cairo_->context.get();
  cairo_save(context);
  cairo_rectangle(context, box.low.x, box.low.y, box.width(), box.height());
  cairo_clip(context);
}

void Canvas::unclip() { cairo_restore(cairo_->context.get()); }

void Canvas::add_polygon(std::span<const Point> corners) {
  cairo_t* context = cairo_->context.get();
  if (corners.empty()) return;
  cairo_move_to(context, corners[0].x, corners[0].y);
  for (const Point& p : corners.subspan(1)) cairo_line_to(context, p.x, p.y);
  cairo_close_path(context);
}

void Canvas::add_line(Point a, Point b) {
  cairo_move_to(cairo_->context.get(), a.x, a.y);
  cairo_line_to(cairo_->context.get(), b.x, b.y);
}

void Canvas::add_polyline(std::span<const Point> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    (i == 0 ? cairo_move_to : cairo_line_to)(cairo_->context.get(), points[i].x, points[i].y);
}

void Canvas::fill_crisp(Colour colour) {
  cairo_t* context = cairo_->context.get();
  cairo_set_source_rgb(context, colour.red, colour.green, colour.blue);
  cairo_set_antialias(context, CAIRO_ANTIALIAS_NONE);
  cairo_fill(context);
  cairo_set_antialias(context, CAIRO_ANTIALIAS_DEFAULT);
}

void Canvas::fill(Colour colour) {
  cairo_set_source_rgb(cairo_->context.get(), colour.red, colour.green, colour.blue);
  cairo_fill(cairo_->context.get());
}

void Canvas::stroke(Colour colour, double opacity, double width) {
  cairo_t* context = cairo_->context.get();
  cairo_set_source_rgba(context, colour.red, colour.green, colour.blue, opacity);
  cairo_set_line_width(context, width);
  cairo_stroke(context);
}

void Canvas::text(Point at, const std::string& text, TextAlign align) {
  cairo_t* context = cairo_->context.get();
  const std::string shown = printable(text);
  const double share = align == TextAlign::left ? 0 : align == TextAlign::centre ? 0.5 : 1;
  cairo_set_source_rgb(context, 0.13, 0.13, 0.13);
  cairo_move_to(context, at.x - share * text_width(shown), at.y + 0.35 * font_size);
  cairo_show_text(context, shown.c_str());
  cairo_new_path(context);
}

void Canvas::text_upwards(Point middle, const std::string& text) {
  cairo_t* context = cairo_->context.get();
  cairo_save(context);
  cairo_translate(context, middle.x, middle.y);
  cairo_rotate(context, -0.5 * std::numbers::pi);
  this->text({0, 0}, text, TextAlign::centre);
  cairo_restore(context);
}

void Canvas::paint(const Box& box, const Image& image) {
  if (image.width < 1 || image.height < 1) return;
  cairo_t* context = cairo_->context.get();
  const Surface picture(cairo_image_surface_create(CAIRO_FORMAT_ARGB32, image.width, image.height));
  require_success(cairo_surface_status(picture.get()));
  const int stride = cairo_image_surface_get_stride(picture.get());
  unsigned char* const rows = cairo_image_surface_get_data(picture.get());
  for (int y = 0; y < image.height; ++y) {
    std::memcpy(rows + static_cast<std::ptrdiff_t>(y) * stride,
                image.pixels.data() + static_cast<std::ptrdiff_t>(y) * image.width,
                image.width * sizeof(std::uint32_t));
  }
  cairo_surface_mark_dirty(picture.get());
  cairo_save(context);
  cairo_translate(context, box.low.x, box.low.y);
  cairo_scale(context, box.width() / image.width, box.height() / image.height);
  cairo_set_source_surface(context, picture.get(), 0, 0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
  cairo_paint(context);
  cairo_restore(context);
}

double Canvas::text_width(const std::string& text) const {
  cairo_text_extents_t extents;
  cairo_text_extents(cairo_->context.get(), printable(text).c_str(), &extents);
  return extents.x_advance;
}

std::string Canvas::finish() {
  require_success(cairo_status(cairo_->context.get()));
  cairo_->context.reset();
  if (cairo_->rows) keep_rows();
  cairo_surface_finish(cairo_->surface.get());
  require_success(cairo_surface_status(cairo_->surface.get()));
  return cairo_->rows ? cairo_->rows->finish() : std::move(cairo_->bytes);
}

}  // namespace quadloop::io
