#pragma once

#include <array>
#include <optional>
#include <string>

#include "io/plot/canvas/plot_format.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop::io {

enum class PlotColouring { type, block, quality };

/// Options of a picture of a mesh.
struct PlotOptions {
  PlotColouring colouring = PlotColouring::type;
  std::string field;          ///< a variable of the solution, instead of `colouring`; empty for none
  std::optional<Box> window;  ///< empty: the whole mesh
  double size = 1600;         ///< pixels along the longer side, including margins; at least 400
  /// Width and height instead, from 5 to 200 each: for SVG and PDF in print, for PNG at 300 dpi.
  std::optional<Point> centimetres = {};

  // For a field:
  /// Range of the colours; empty: that of the values in the window.
  std::optional<std::array<double, 2>> range = {};
  std::string map = "viridis";  ///< the colours: viridis, coolwarm, grey or plasma
  bool smooth = true;           ///< linear over triangles, bilinear over quads; else each cell has one colour
  std::optional<bool> lines = {};  ///< of the mesh; empty: drawn unless a field is shown
  int contours = 0;                ///< number of contour lines, equidistant in the range
  int streamlines = 0;  ///< of the velocity: approximate number across the picture's shorter side; 0: none
};

}  // namespace quadloop::io
