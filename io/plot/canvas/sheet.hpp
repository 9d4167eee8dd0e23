#pragma once

#include <optional>

#include "io/plot/canvas/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

/// The size of a sheet, and the scale of its units in the file and in images on it.
struct Sheet {
  std::optional<Point> size;  ///< if both dimensions are given
  double scale = 1;           ///< pixels or points of the file per unit
  double resolution = 1;      ///< pixels of an image per unit
};

/// Returns a sheet of this width and height: text of 16 units is 8 pt high in print; 300 dpi.
inline Sheet sheet_of(std::optional<Point> centimetres, PlotFormat format) {
  if (!centimetres) return {};
  constexpr double units_per_centimetre = 144 / 2.54, points = 0.5, dots = 300 / 144.0;
  return {units_per_centimetre * *centimetres, format == PlotFormat::png ? dots : points, dots};
}

}  // namespace quadloop::io
