#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "io/plot/canvas/colour_map.hpp"
#include "io/plot/canvas/plot_canvas.hpp"
#include "io/plot/cell_stream.hpp"
#include "io/plot/plot_view.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

/// A triangle on the sheet with a linear value.
struct LinearPiece {
  std::array<Point, 3> corners;
  std::array<double, 3> values;
};

/// Appends the cell as pieces on the sheet: a triangle is one; a quadrilateral, whose value is bilinear, is
/// divided as finely as its size on the sheet requires.
void append_pieces(const PlotView& view, const ShownCell& cell, std::vector<LinearPiece>& pieces);

/// Values at the pixels of a part of a sheet.
class ValueRaster {
 public:
  /// Covers at least `frame`, in whole pixels; `resolution` is the number of pixels per unit of the sheet.
  ValueRaster(const Box& frame, double resolution);

  /// Adds the part of the piece inside this raster: the value at each pixel's centre.
  void add(const LinearPiece& piece);

  /// Returns the value at a point of the sheet, linear between pixel centres; NaN outside the pieces and next
  /// to their border.
  double at(Point place) const;

  /// Pixels without a value are transparent, values that are not finite are grey.
  Image image(const ColourBar& bar) const;

  const Box& box() const { return box_; }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  Box box_;
  double resolution_;
  int width_, height_;
  std::vector<float> values_;  ///< NaN: no value; infinity: a value that is not finite
};

}  // namespace quadloop::io
