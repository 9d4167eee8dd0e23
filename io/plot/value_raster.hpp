#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "io/plot/canvas/colour_map.hpp"
#include "io/plot/canvas/plot_canvas.hpp"
#include "io/plot/plot_view.hpp"
#include "mesher/geometry/point.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// A triangle on the sheet over which a value is linear.
struct LinearPiece {
  std::array<Point, 3> corners;
  std::array<double, 3> values;
};

/// The cell as pieces on the sheet: a triangle is one; a quadrilateral, over which the value is bilinear, is
/// divided as finely as its size on the sheet asks for. `values` are those of the mesh's nodes.
void append_pieces(const Mesh& mesh, const PlotView& view, std::size_t cell,
                   const std::vector<double>& values, std::vector<LinearPiece>& pieces);

/// Values at the pixels of a part of a sheet.
class ValueRaster {
 public:
  /// Over at least `frame`, whole pixels of which `resolution` make up one of the sheet.
  ValueRaster(const Box& frame, double resolution);

  /// What of the piece lies here: the value at each pixel's middle.
  void add(const LinearPiece& piece);

  /// The value at a place of the sheet, linear between the pixels' middles; not a number outside the pieces
  /// and beside them.
  double at(Point place) const;

  /// Pixels without a value are left out, values that are not finite are grey.
  Image image(const ColourBar& bar) const;

  const Box& box() const { return box_; }

 private:
  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  Box box_;
  double resolution_;
  int width_, height_;
  std::vector<float> values_;  ///< not a number: none; infinite: one that is not finite
};

}  // namespace quadloop
