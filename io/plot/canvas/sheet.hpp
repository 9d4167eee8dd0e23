#pragma once

#include <optional>

#include "io/plot/canvas/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

/// How large a sheet is, and how large its units are in the file and in images on it.
struct Sheet {
  std::optional<Point> size;  ///< where it is given in both directions
  double scale = 1;           ///< of the file's pixels or points, to a unit
  double resolution = 1;      ///< of an image's pixels, to a unit
};

/// A sheet of this width and height: text of 16 units is 8 pt high in print; 300 dots an inch.
inline Sheet sheet_of(std::optional<Point> centimetres, PlotFormat format) {
  if (!centimetres) return {};
  constexpr double units_per_centimetre = 144 / 2.54, points = 0.5, dots = 300 / 144.0;
  return {units_per_centimetre * *centimetres, format == PlotFormat::png ? dots : points, dots};
}

}  // namespace quadloop
