#include "io/plot/mesh_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <span>
#include <tuple>
#include <utility>

#include "io/plot/contour_lines.hpp"
#include "io/plot/streamlines.hpp"
#include "io/plot/value_raster.hpp"
#include "mesher/base/parallel/exchange.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop::io {

namespace {

constexpr Colour edge_ink{0.13, 0.17, 0.25}, line_ink{0.08, 0.08, 0.1};
constexpr std::size_t batch = 1000;  // polygons or lines per path
constexpr double smallest = 1.3;     // pixels between two edges that are still drawn individually
constexpr double darkest = 0.42;     // maximum fraction of ink in an area with edges, or with shading instead
constexpr std::size_t width_classes = 48;
constexpr double thickest = 2.6;  // pixels of a line

/// Draws what is added to a path, a batch at a time.
class Batches {
 public:
  /// Calls `draw` for each full batch, and for the last one.
  template <class Draw>
  void count_one(const Draw& draw) {
    if (++count_ % batch == 0) draw();
  }
  template <class Draw>
  void finish(const Draw& draw) const {
    if (count_ % batch != 0) draw();
  }

 private:
  std::size_t count_ = 0;
};

double area_of(const Mesh& mesh, std::span<const NodeId> nodes) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
    twice +=
        cross(mesh.point(nodes[i]) - mesh.point(nodes[0]), mesh.point(nodes[i + 1]) - mesh.point(nodes[0]));
  return 0.5 * std::abs(twice);
}

std::vector<PlotEdge> edges_of(const Mesh& mesh, std::size_t cell, double scale) {
  const std::span<const NodeId> nodes = cell_nodes(mesh, cell);
  const double area = area_of(mesh, nodes);
  std::vector<PlotEdge> edges;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    NodeId a = nodes[i], b = nodes[(i + 1) % nodes.size()];
    if (mesh.global(b) < mesh.global(a)) std::swap(a, b);
    const double along = length(mesh.point(b) - mesh.point(a));
    edges.push_back({a, b, along > 0 ? scale * area / along : 0});
  }
  return edges;
}

/// The edges of cells, unless they are too close to be drawn.
std::vector<PlotEdge> edges_thick_enough(const Mesh& mesh, const std::vector<std::size_t>& cells,
                                         double scale) {
  std::vector<PlotEdge> edges;
  for (const std::size_t cell : cells) {
    for (const PlotEdge& edge : edges_of(mesh, cell, scale)) {
      if (edge.thickness >= smallest) edges.push_back(edge);
    }
  }
  return edges;
}

/// Whether a cell or a line can be seen in a part of the sheet.
bool is_seen(const PlotView& view, const Box& part, std::span<const Point> corners) {
  const Point room{thickest, thickest};
  Box around;
  for (const Point& corner : corners) around.include(view.pixel(corner));
  return around.meets({part.low - room, part.high + room});
}

bool is_cell_seen(const Mesh& mesh, const PlotView& view, const Box& part, std::size_t cell) {
  std::array<Point, 4> corners;
  const std::span<const NodeId> nodes = cell_nodes(mesh, cell);
  std::ranges::transform(nodes, corners.begin(), [&](NodeId node) { return mesh.point(node); });
  return is_seen(view, part, std::span(corners).first(nodes.size()));
}

/// Adds the visible part of a line. `to_left`: pixels by which it is moved to its left.
void add_line(Canvas& canvas, const PlotView& view, Point from, Point to, double to_left = 0) {
  if (to_left != 0) {
    const Point along = to - from,
                shift = to_left / (view.scale() * length(along)) * Point{-along.y, along.x};
    from = from + shift;
    to = to + shift;
  }
  if (const auto part = view.visible_part(from, to))
    canvas.add_line(view.pixel((*part)[0]), view.pixel((*part)[1]));
}

/// Returns a small triangle at the middle of a line that shows its direction.
std::array<Point, 3> arrow_on(const std::vector<Point>& line) {
  constexpr double size = 9;
  const std::size_t middle = line.size() / 2;
  const Point along = line[middle] - line[middle - 1];
  const Point way = size / length(along) * along, across{-0.4 * way.y, 0.4 * way.x};
  return {line[middle] + 0.5 * way, line[middle] - 0.5 * way + across, line[middle] - 0.5 * way - across};
}

}  // namespace

CellLayer::CellLayer(const CellStream& stream, const PlotView& view, const std::vector<std::size_t>& cells,
                     const CellPaint& paint)
    : stream_{stream}, view_{view}, cells_{cells} {
  for (const Colour& colour : paint.palette) {
    palette_.push_back(colour);
    palette_.push_back(mixed(colour, edge_ink, darkest));
  }
  colours_.reserve(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double thickness = smallest;
    if (!paint.bar) {
      for (const PlotEdge& edge : edges_of(stream.mesh(), cells[i], view.scale()))
        thickness = std::min(thickness, edge.thickness);
    }
    colours_.push_back(static_cast<std::uint16_t>(2 * paint.colours[i] + (thickness < smallest ? 1 : 0)));
  }
}

void CellLayer::draw(const ShownStrip& strip) const {
  std::vector<std::vector<std::size_t>> by_colour(palette_.size());
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    if (is_cell_seen(stream_.mesh(), view_, strip.part, cells_[i]))
      by_colour[colours_[i]].push_back(cells_[i]);
  }
  for (std::size_t colour = 0; colour < palette_.size(); ++colour) {
    Batches batches;
    const auto draw_batch = [&] { strip.canvas->fill_crisp(palette_[colour]); };
    stream_.for_each(by_colour[colour], {}, [&](const ShownCell& cell) {
      std::vector<Point> corners =
          view_.visible_part({cell.corners.begin(), cell.corners.begin() + cell.width});
      for (Point& p : corners) p = view_.pixel(p);
      strip.canvas->add_polygon(corners);
      batches.count_one(draw_batch);
    });
    batches.finish(draw_batch);
  }
}

DrawnEdges::DrawnEdges(const Communicator& comm, const Mesh& mesh, std::vector<PlotEdge> own)
    : mesh_{mesh}, edges_{std::move(own)} {
  make_unique();
  take_from_others(comm);
  make_unique();
}

void DrawnEdges::make_unique() {
  const auto nodes = [&](const PlotEdge& edge) { return std::pair(mesh_.global(edge.a), global(edge.b)); };
  std::sort(edges_.begin(), edges_.end(), [&](const PlotEdge& p, const PlotEdge& q) {
    return std::tuple(nodes(p), q.thickness) < std::tuple(nodes(q), p.thickness);
  });
  const auto again = std::ranges::unique(edges_, {}, nodes);
  edges_.erase(again.begin(), again.end());
}

/// *Collective.*
void DrawnEdges::take_from_others(const Communicator& comm) {
  const NodeOwners owners(comm, mesh_.first_node);
  Outbox<TravellingEdge> out;
  std::erase_if(edges_, [&](const PlotEdge& edge) {
    if (mesh_.owns(edge.a)) return false;
    const GlobalNodeId first = mesh_.global(edge.a);
    out.add(owners.rank_of(first), {first, {global(edge.b), place(edge.b)}, edge.thickness});
    return true;
  });
  for (const TravellingEdge& edge : out.deliver(comm)) {
    edges_.push_back(
        {owners.local(edge.first), NodeId{size32(mesh_.points) + size32(others_)}, edge.thickness});
    others_.push_back(edge.second);
  }
}

EdgeLayer::EdgeLayer(const CellStream& stream, const PlotView& view, const std::vector<std::size_t>& cells,
                     double strength)
    : stream_{stream},
      view_{view},
      strength_{strength},
      drawn_(stream.communicator(), stream.mesh(), edges_thick_enough(stream.mesh(), cells, view.scale())),
      by_width_(width_classes) {
  for (std::int32_t i = 0; i < size32(drawn_.edges()); ++i) {
    const double eighths = 8 * std::log2(drawn_.edges()[i].thickness / smallest);
    by_width_[static_cast<std::size_t>(std::clamp(eighths, 0.0, width_classes - 1.0))].push_back(i);
  }
}

void EdgeLayer::draw(const ShownStrip& strip) const {
  for (std::size_t k = 0; k < by_width_.size(); ++k) {
    const double thickness = smallest * std::exp2(0.125 * static_cast<double>(k));
    const double width = std::clamp(thickness / 16, 0.5, 1.1);
    const double opacity = strength_ * std::min(0.85, darkest * thickness / (2 * width));
    std::vector<std::array<Point, 2>> lines;
    for (const std::int32_t edge : by_width_[k]) {
      const std::array<Point, 2> ends = drawn_.ends(drawn_.edges()[edge]);
      if (is_seen(view_, strip.part, ends)) lines.push_back(ends);
    }
    Batches batches;
    const auto draw_batch = [&] { strip.canvas->stroke(edge_ink, opacity, width); };
    hand_to_root(
        stream_.communicator(), lines.size(), [&](std::size_t i) { return lines[i]; },
        [&](const std::array<Point, 2>& ends) {
          add_line(*strip.canvas, view_, ends[0], ends[1]);
          batches.count_one(draw_batch);
        });
    batches.finish(draw_batch);
  }
}

PlacedEdges::PlacedEdges(const Mesh& mesh) {
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges) places_.push_back({mesh.point(from), mesh.point(to)});
  }
  std::ranges::sort(places_);
}

void BoundaryLayer::draw(const ShownStrip& strip) const {
  for (std::size_t i = 0; strip.canvas != nullptr && i < boundaries_.boundaries.size(); ++i)
    draw_boundary(strip, boundaries_.boundaries[i], colour_of_(i));
}

void BoundaryLayer::draw_boundary(const ShownStrip& strip, const BoundaryEdges& boundary,
                                  Colour colour) const {
  const auto ends_of = [&](const std::array<NodeId, 2>& edge) {
    return std::array{boundaries_.point(edge[0]), boundaries_.point(edge[1])};
  };
  double along = 0;
  for (const auto& edge : boundary.edges) {
    const auto [a, b] = ends_of(edge);
    along += view_.scale() * length(b - a);
  }
  const double width = std::clamp(1.0 + along / (4.0 * size32(boundary.edges)), 1.7, thickest);
  Batches batches;
  const auto draw_batch = [&] { strip.canvas->stroke(colour, 1, width); };
  for (const auto& edge : boundary.edges) {
    const std::array<Point, 2> ends = ends_of(edge);
    if (!is_seen(view_, strip.part, ends)) continue;
    const bool has_other_side = placed_.has(ends[1], ends[0]);
    add_line(*strip.canvas, view_, ends[0], ends[1], has_other_side ? 0.5 * width : 0);
    batches.count_one(draw_batch);
  }
  batches.finish(draw_batch);
}

template <class Visit>
void FieldPainter::for_each_piece(const Box& part, const std::vector<double>& values,
                                  const Visit& visit) const {
  std::vector<std::size_t> seen;
  std::ranges::copy_if(cells_, std::back_inserter(seen),
                       [&](std::size_t cell) { return is_cell_seen(stream_.mesh(), view_, part, cell); });
  std::vector<LinearPiece> pieces;
  stream_.for_each(seen, values, [&](const ShownCell& cell) {
    pieces.clear();
    append_pieces(view_, cell, pieces);
    for (const LinearPiece& piece : pieces) visit(piece);
  });
}

/// Returns the values at the pixels of a part of the frame on the root, nothing elsewhere. *Collective.*
std::optional<ValueRaster> FieldPainter::raster_of(const Box& part, const std::vector<double>& values) const {
  std::optional<ValueRaster> raster;
  if (stream_.communicator().is_root()) raster.emplace(part, resolution_);
  for_each_piece(part, values, [&](const LinearPiece& piece) { raster->add(piece); });
  return raster;
}

void FieldPainter::shade(const ShownStrip& strip, const std::vector<double>& values,
                         const ColourBar& bar) const {
  const Box& frame = view_.frame();
  const Box part{{frame.low.x, std::max(frame.low.y, strip.part.low.y)},
                 {frame.high.x, std::min(frame.high.y, strip.part.high.y)}};
  if (!(part.low.y < part.high.y)) return;
  const std::optional<ValueRaster> raster = raster_of(part, values);
  if (raster) strip.canvas->paint(raster->box(), raster->image(bar));
}

void FieldPainter::stroke_contours(const ShownStrip& strip, const std::vector<double>& values,
                                   const std::vector<double>& levels) const {
  Batches batches;
  const auto draw_batch = [&] { strip.canvas->stroke(line_ink, 1, 1); };
  std::vector<std::array<Point, 2>> lines;
  for_each_piece(strip.part, values, [&](const LinearPiece& piece) {
    lines.clear();
    append_contours(piece, levels, lines);
    for (const auto& [from, to] : lines) {
      if (const auto part = part_within(view_.frame(), from, to))
        strip.canvas->add_line((*part)[0], (*part)[1]);
      batches.count_one(draw_batch);
    }
  });
  batches.finish(draw_batch);
}

std::vector<std::vector<Point>> FieldPainter::streamlines(const std::vector<double>& x_velocity,
                                                          const std::vector<double>& y_velocity,
                                                          int count) const {
  const std::optional<ValueRaster> x_raster = raster_of(view_.frame(), x_velocity),
                                   y_raster = raster_of(view_.frame(), y_velocity);
  if (!x_raster) return {};
  return io::streamlines(*x_raster, *y_raster, count);
}

void stroke_streamlines(Canvas& canvas, const std::vector<std::vector<Point>>& lines) {
  for (const std::vector<Point>& line : lines) canvas.add_polyline(line);
  canvas.stroke(line_ink, 1, 1);
  for (const std::vector<Point>& line : lines) {
    canvas.add_polygon(arrow_on(line));
    canvas.fill(line_ink);
  }
}

}  // namespace quadloop::io
