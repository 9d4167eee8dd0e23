#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "io/plot/canvas/plot_canvas.hpp"
#include "io/plot/cell_paint.hpp"
#include "io/plot/cell_stream.hpp"
#include "io/plot/plot_view.hpp"
#include "io/plot/value_raster.hpp"

namespace quadloop::io {

/// The boundary edges of a mesh by the places of their nodes.
class PlacedEdges {
 public:
  explicit PlacedEdges(const Mesh& mesh);
  /// Whether a boundary has an edge from `from` to `to`.
  bool has(Point from, Point to) const { return std::ranges::binary_search(places_, Place{from, to}); }

 private:
  using Place = std::array<Point, 2>;

  std::vector<Place> places_;  ///< ascending
};

/// Draws a distributed mesh on the root's canvas, layer by layer.
class MeshPainter {
 public:
  /// `boundaries` are those of all ranks, and `canvas` is that of the root; other ranks need neither.
  MeshPainter(const CellStream& stream, const Mesh& boundaries, const PlotView& view, Canvas* canvas)
      : stream_{stream}, boundaries_{boundaries}, view_{view}, canvas_{canvas}, boundary_edges_{boundaries} {}

  /// Fills each cell with its colour. Cells too thin for drawing their edges are shaded instead, unless
  /// colours represent values. *Collective.*
  void fill(const std::vector<std::size_t>& cells, const CellPaint& paint);

  /// Draws each edge once, by the thicker of its cells; the closer the edges, the thinner and paler they are,
  /// so that a fine mesh does not turn black. All edges have the same ink: if it depended on the colours
  /// below, it would look like a line where these change. *Collective.*
  void stroke_edges(const std::vector<std::size_t>& cells, double strength);

  /// On the root: thinner where edges are short: a coast drawn in bold would fill its own bays. The two sides
  /// of a baffle, whose edges coincide, are drawn beside each other.
  void stroke_boundary(const BoundaryEdges& boundary, Colour colour);

 private:
  void fill_all(const std::vector<std::size_t>& cells, Colour colour);
  void add_line(Point from, Point to, double to_left = 0);

  const CellStream& stream_;
  const Mesh& boundaries_;
  const PlotView& view_;
  Canvas* canvas_;
  PlacedEdges boundary_edges_;
};

/// Draws a field on a distributed mesh. Values are those of this rank's nodes and ghosts.
class FieldPainter {
 public:
  /// `cells` are those in the window, and `canvas` is that of the root; other ranks need none. `resolution`:
  /// pixels of the picture per pixel of the sheet.
  FieldPainter(const CellStream& stream, const std::vector<std::size_t>& cells, const PlotView& view,
               Canvas* canvas, double resolution)
      : stream_{stream}, cells_{cells}, view_{view}, canvas_{canvas}, resolution_{resolution} {}

  /// *Collective.*
  void shade(const std::vector<double>& values, const ColourBar& bar);
  /// *Collective.*
  void stroke_contours(const std::vector<double>& values, const std::vector<double>& levels);
  /// *Collective.*
  void stroke_streamlines(const std::vector<double>& x_velocity, const std::vector<double>& y_velocity,
                          int count);

 private:
  template <class Visit>
  void for_each_piece(const std::vector<double>& values, const Visit& visit) const;
  std::optional<ValueRaster> raster_of(const std::vector<double>& values) const;

  const CellStream& stream_;
  const std::vector<std::size_t>& cells_;
  const PlotView& view_;
  Canvas* canvas_;
  double resolution_;
};

}  // namespace quadloop::io
