#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "io/plot/canvas/plot_format.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

/// Red, green and blue, each from 0 to 1.
struct Colour {
  double red = 0, green = 0, blue = 0;
};

/// Mixes a with the fraction `share` of b.
constexpr Colour mixed(Colour a, Colour b, double share) {
  return {a.red + share * (b.red - a.red), a.green + share * (b.green - a.green),
          a.blue + share * (b.blue - a.blue)};
}

enum class TextAlign { left, centre, right };

/// An image, row by row from the top; each pixel has 8 bits of alpha (0 or 255), red, green, blue.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint32_t> pixels;
};

/// The strips of a sheet, from its top: parts that are drawn one after the other, so that the pixels of only
/// one of them are in memory. SVG and PDF have no pixels, and one strip.
class Strips {
 public:
  /// `scale`: pixels of the file (SVG and PDF: points) per pixel of the sheet.
  Strips(PlotFormat format, double width, double height, double scale);
  /// The same sheet in one strip.
  static Strips one(PlotFormat format, double width, double height, double scale = 1);

  int count() const { return (height_ + rows_ - 1) / rows_; }
  /// The part of the sheet in a strip.
  Box part(int strip) const;

 private:
  friend class Canvas;
  Strips() = default;

  PlotFormat format_ = PlotFormat::png;
  Point size_;  ///< of the sheet
  double scale_ = 1;
  int width_ = 1, height_ = 1;  ///< in pixels of the file
  int rows_ = 1;                ///< of a strip, in pixels of the file
};

/// A white sheet in pixels, with the origin at its top left and y downwards. Added lines and polygons form
/// one path until it is filled or stroked. Coordinates must stay within about 10^6 pixels. The same calls
/// give the same bytes. Every strip must be drawn with all calls that touch it; next_strip() begins the next
/// one.
class Canvas {
 public:
  explicit Canvas(const Strips& strips);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// Clips what follows to the box, until unclip().
  void clip(const Box& box);
  void unclip();

  void add_polygon(std::span<const Point> corners);
  void add_line(Point a, Point b);
  void add_polyline(std::span<const Point> points);
  /// A crisp fill assigns each pixel to one polygon only, so that neighbours have no visible seam.
  void fill_crisp(Colour colour);
  void fill(Colour colour);
  void stroke(Colour colour, double opacity, double width);

  /// `at`: the middle of the text's height at its left, centre or right. Text that is not UTF-8 is reduced to
  /// ASCII.
  void text(Point at, const std::string& text, TextAlign align = TextAlign::left);
  /// Rotated to run upwards, centred at `middle`.
  void text_upwards(Point middle, const std::string& text);
  double text_width(const std::string& text) const;

  /// Scales the image to the box.
  void paint(const Box& box, const Image& image);

  /// Throws a Fault if Cairo failed.
  void next_strip();

  /// Returns the picture's bytes after the last strip; the canvas must not be used afterwards. Throws a Fault
  /// if Cairo failed.
  std::string finish();

 private:
  void begin_strip();
  void keep_rows();

  struct Cairo;
  std::unique_ptr<Cairo> cairo_;
};

}  // namespace quadloop::io
