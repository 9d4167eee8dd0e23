#pragma once

#include <vector>

#include "io/plot/canvas/plot_canvas.hpp"
#include "io/plot/cell_paint.hpp"
#include "io/plot/plot_view.hpp"
#include "io/plot/value_raster.hpp"

namespace quadloop {

/// Draws one mesh on one canvas, layer by layer.
class MeshPainter {
 public:
  MeshPainter(const Mesh& mesh, const PlotView& view, Canvas& canvas)
      : mesh_{mesh}, view_{view}, canvas_{canvas} {}

  /// Each cell in its colour. Cells too thin for their edges to be drawn are shaded instead; not where colour
  /// stands for a number.
  void fill(const std::vector<std::size_t>& cells, const CellPaint& paint);

  /// Each edge once, by the thicker of its cells; the closer edges lie, the thinner and paler they are, so
  /// that a fine mesh does not turn black. In one ink all over: one that followed the colours below would
  /// draw a line where it changes.
  void stroke_edges(const std::vector<std::size_t>& cells, double strength);

  /// Thinner where its edges are short: a coast drawn in bold would fill its own bays.
  void stroke_boundary(const BoundaryEdges& boundary, Colour colour);

 private:
  void fill_all(const std::vector<std::size_t>& cells, Colour colour);
  void add_line(NodeId a, NodeId b);

  const Mesh& mesh_;
  const PlotView& view_;
  Canvas& canvas_;
};

/// Draws what a field is over a mesh. `values` has one for each node.
class FieldPainter {
 public:
  /// `resolution`: pixels of the picture that make up one of the sheet.
  FieldPainter(const Mesh& mesh, const std::vector<std::size_t>& cells, const PlotView& view, Canvas& canvas,
               double resolution)
      : mesh_{mesh}, cells_{cells}, view_{view}, canvas_{canvas}, resolution_{resolution} {}

  void shade(const std::vector<double>& values, const ColourBar& bar);
  void stroke_contours(const std::vector<double>& values, const std::vector<double>& levels);
  void stroke_streamlines(const std::vector<double>& x_velocity, const std::vector<double>& y_velocity,
                          int count);

 private:
  ValueRaster raster_of(const std::vector<double>& values) const;

  const Mesh& mesh_;
  const std::vector<std::size_t>& cells_;
  const PlotView& view_;
  Canvas& canvas_;
  double resolution_;
};

}  // namespace quadloop
