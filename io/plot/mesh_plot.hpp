#pragma once

#include <array>
#include <optional>
#include <string>

#include "io/model/loaded_mesh.hpp"
#include "io/plot/canvas/colour_map.hpp"
#include "io/plot/canvas/plot_canvas.hpp"
#include "mesher/geometry/point.hpp"

namespace quadloop {

enum class PlotColouring { type, block, quality };

/// What a picture of a mesh shows.
struct PlotOptions {
  PlotColouring colouring = PlotColouring::type;
  std::string field;          ///< a variable of the solution, instead of `colouring`; empty for none
  std::optional<Box> window;  ///< the whole mesh where absent
  double size = 1600;         ///< pixels along the longer side, margins included; at least 400
  /// Width and height instead, from 5 to 200 each: of SVG and PDF in print, of PNG at 300 dots an inch.
  std::optional<Point> centimetres = {};

  // Of a field:
  std::optional<std::array<double, 2>> range = {};  ///< what the colours span; absent: the window's values
  ColourMap map = perceptual_colour;
  bool smooth = true;  ///< linear over triangles, bilinear over quads; else each cell has one colour
  std::optional<bool> lines = {};  ///< of the mesh; absent: where no field is shown
  int contours = 0;                ///< how many lines of equal values, evenly in the range
  int streamlines = 0;  ///< of the velocity: about so many across the picture's shorter side; 0: none
};

/// The picture of a mesh, as a file's bytes. Cells and edges too small to be told apart become an even shade.
/// Throws InputError, "what is wrong; what to do" without a file's name: an empty window, one that shows no
/// cell, a field that is not there.
std::string draw_mesh(const LoadedMesh& loaded, const PlotOptions& options, PlotFormat format);

}  // namespace quadloop
