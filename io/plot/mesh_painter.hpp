#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "io/plot/canvas/plot_canvas.hpp"
#include "io/plot/cell_paint.hpp"
#include "io/plot/cell_stream.hpp"
#include "io/plot/plot_view.hpp"
#include "io/plot/value_raster.hpp"

namespace quadloop::io {

/// A strip of the sheet, with the canvas that shows it on the root, none elsewhere.
struct ShownStrip {
  Canvas* canvas = nullptr;
  Box part;  ///< of the sheet
};

/// The coloured cells of a distributed mesh. Cells too thin for drawing their edges are shaded instead,
/// unless colours represent values.
class CellLayer {
 public:
  /// `cells`: those of this rank in the window. The arguments must outlive the object.
  CellLayer(const CellStream& stream, const PlotView& view, const std::vector<std::size_t>& cells,
            const CellPaint& paint);
  /// *Collective.*
  void draw(const ShownStrip& strip) const;

 private:
  const CellStream& stream_;
  const PlotView& view_;
  const std::vector<std::size_t>& cells_;
  std::vector<Colour> palette_;
  std::vector<std::uint16_t> colours_;  ///< indices into the palette, one for each cell
};

/// An edge between two nodes, that with the lower global number first, with the thickness in pixels of an
/// adjacent cell.
struct PlotEdge {
  NodeId a, b;
  double thickness = 0;
};

/// The edges of a distributed mesh that are drawn, each once, by the thicker of its cells, on the rank that
/// owns its first node, in the order of the nodes.
class DrawnEdges {
 public:
  /// `own` are the edges of this rank's cells. *Collective.*
  DrawnEdges(const Communicator& comm, const Mesh& mesh, std::vector<PlotEdge> own);

  const std::vector<PlotEdge>& edges() const { return edges_; }
  std::array<Point, 2> ends(const PlotEdge& edge) const { return {mesh_.point(edge.a), place(edge.b)}; }

 private:
  struct End {
    GlobalNodeId node;
    Point place;
  };
  struct TravellingEdge {
    GlobalNodeId first;
    End second;
    double thickness;
  };

  /// Nodes that this rank does not know are numbered after those of the mesh.
  bool is_known(NodeId node) const { return node.value() < size32(mesh_.points); }
  const End& other(NodeId node) const { return others_[node.value() - mesh_.points.size()]; }
  GlobalNodeId global(NodeId node) const { return is_known(node) ? mesh_.global(node) : other(node).node; }
  Point place(NodeId node) const { return is_known(node) ? mesh_.point(node) : other(node).place; }
  void make_unique();
  void take_from_others(const Communicator& comm);

  const Mesh& mesh_;
  std::vector<PlotEdge> edges_;
  std::vector<End> others_;
};

/// The edges of a distributed mesh as lines: the closer the edges, the thinner and paler they are, so that a
/// fine mesh does not turn black. All edges have the same ink: if it depended on the colours below, it would
/// look like a line where these change.
class EdgeLayer {
 public:
  /// `cells`: those of this rank in the window. `strength`: a factor of the opacity. The stream and the view
  /// must outlive the object. *Collective.*
  EdgeLayer(const CellStream& stream, const PlotView& view, const std::vector<std::size_t>& cells,
            double strength);
  /// *Collective.*
  void draw(const ShownStrip& strip) const;

 private:
  const CellStream& stream_;
  const PlotView& view_;
  double strength_;
  DrawnEdges drawn_;
  std::vector<std::vector<std::int32_t>> by_width_;  ///< indices of edges
};

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

/// The boundaries as lines, thinner where edges are short: a coast drawn in bold would fill its own bays. The
/// two sides of a baffle, whose edges coincide, are drawn beside each other.
class BoundaryLayer {
 public:
  /// `boundaries` are those of all ranks on the root, none elsewhere. The view must outlive the object.
  BoundaryLayer(Mesh boundaries, const PlotView& view, Colour (*colour_of)(std::size_t boundary))
      : boundaries_{std::move(boundaries)}, placed_{boundaries_}, view_{view}, colour_of_{colour_of} {}
  void draw(const ShownStrip& strip) const;

 private:
  void draw_boundary(const ShownStrip& strip, const BoundaryEdges& boundary, Colour colour) const;

  Mesh boundaries_;
  PlacedEdges placed_;
  const PlotView& view_;
  Colour (*colour_of_)(std::size_t boundary);
};

/// Draws fields on a distributed mesh. Values are those of this rank's nodes and ghosts.
class FieldPainter {
 public:
  /// `cells` are those in the window. `resolution`: pixels of the picture per pixel of the sheet. The
  /// arguments must outlive the object.
  FieldPainter(const CellStream& stream, const std::vector<std::size_t>& cells, const PlotView& view,
               double resolution)
      : stream_{stream}, cells_{cells}, view_{view}, resolution_{resolution} {}

  /// *Collective.*
  void shade(const ShownStrip& strip, const std::vector<double>& values, const ColourBar& bar) const;
  /// *Collective.*
  void stroke_contours(const ShownStrip& strip, const std::vector<double>& values,
                       const std::vector<double>& levels) const;
  /// Returns the streamlines of the whole sheet on the root, none elsewhere. *Collective.*
  std::vector<std::vector<Point>> streamlines(const std::vector<double>& x_velocity,
                                              const std::vector<double>& y_velocity, int count) const;

 private:
  template <class Visit>
  void for_each_piece(const Box& part, const std::vector<double>& values, const Visit& visit) const;
  std::optional<ValueRaster> raster_of(const Box& part, const std::vector<double>& values) const;

  const CellStream& stream_;
  const std::vector<std::size_t>& cells_;
  const PlotView& view_;
  double resolution_;
};

/// Draws streamlines, each with an arrow.
void stroke_streamlines(Canvas& canvas, const std::vector<std::vector<Point>>& lines);

}  // namespace quadloop::io
