#include "io/plot/mesh_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
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
constexpr std::size_t batch = 4000;  // polygons or lines per path
constexpr double smallest = 1.3;     // pixels between two edges that are still drawn individually
constexpr double darkest = 0.42;     // maximum fraction of ink in an area with edges, or with shading instead
constexpr std::size_t width_classes = 48;

/// An edge between two nodes, that with the lower global number first, with the thickness in pixels of an
/// adjacent cell.
struct Edge {
  NodeId a, b;
  double thickness = 0;
};

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

std::vector<Edge> edges_of(const Mesh& mesh, std::size_t cell, double scale) {
  const std::span<const NodeId> nodes = cell_nodes(mesh, cell);
  const double area = area_of(mesh, nodes);
  std::vector<Edge> edges;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    NodeId a = nodes[i], b = nodes[(i + 1) % nodes.size()];
    if (mesh.global(b) < mesh.global(a)) std::swap(a, b);
    const double along = length(mesh.point(b) - mesh.point(a));
    edges.push_back({a, b, along > 0 ? scale * area / along : 0});
  }
  return edges;
}

/// The edges that are drawn, each once, by the thicker of its cells, on the rank that owns its first node, in
/// the order of the nodes.
class DrawnEdges {
 public:
  /// `own` are the edges of this rank's cells. *Collective.*
  DrawnEdges(const Communicator& comm, const Mesh& mesh, std::vector<Edge> own)
      : mesh_{mesh}, edges_{std::move(own)} {
    make_unique();
    take_from_others(comm);
    make_unique();
  }

  const std::vector<Edge>& edges() const { return edges_; }
  std::array<Point, 2> ends(const Edge& edge) const { return {mesh_.point(edge.a), end_of(edge.b).place}; }

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
  End end_of(NodeId node) const {
    const std::int32_t known = size32(mesh_.points);
    return node.value() < known ? End{mesh_.global(node), mesh_.point(node)} : others_[node.value() - known];
  }

  void make_unique() {
    const auto nodes = [&](const Edge& edge) { return std::pair(mesh_.global(edge.a), end_of(edge.b).node); };
    std::sort(edges_.begin(), edges_.end(), [&](const Edge& p, const Edge& q) {
      return std::tuple(nodes(p), q.thickness) < std::tuple(nodes(q), p.thickness);
    });
    const auto again = std::ranges::unique(edges_, {}, nodes);
    edges_.erase(again.begin(), again.end());
  }

  /// *Collective.*
  void take_from_others(const Communicator& comm) {
    const NodeOwners owners(comm, mesh_.first_node);
    Outbox<TravellingEdge> out;
    std::erase_if(edges_, [&](const Edge& edge) {
      if (mesh_.owns(edge.a)) return false;
      const GlobalNodeId first = mesh_.global(edge.a);
      out.add(owners.rank_of(first), {first, end_of(edge.b), edge.thickness});
      return true;
    });
    for (const TravellingEdge& edge : out.deliver(comm)) {
      edges_.push_back(
          {owners.local(edge.first), NodeId{size32(mesh_.points) + size32(others_)}, edge.thickness});
      others_.push_back(edge.second);
    }
  }

  const Mesh& mesh_;
  std::vector<Edge> edges_;
  std::vector<End> others_;
};

/// Returns a small triangle at the middle of a line that shows its direction.
std::array<Point, 3> arrow_on(const std::vector<Point>& line) {
  constexpr double size = 9;
  const std::size_t middle = line.size() / 2;
  const Point along = line[middle] - line[middle - 1];
  const Point way = size / length(along) * along, across{-0.4 * way.y, 0.4 * way.x};
  return {line[middle] + 0.5 * way, line[middle] - 0.5 * way + across, line[middle] - 0.5 * way - across};
}

}  // namespace

PlacedEdges::PlacedEdges(const Mesh& mesh) {
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges) places_.push_back({mesh.point(from), mesh.point(to)});
  }
  std::ranges::sort(places_);
}

void MeshPainter::fill_all(const std::vector<std::size_t>& cells, Colour colour) {
  Batches batches;
  const auto draw = [&] { canvas_->fill_crisp(colour); };
  stream_.for_each(cells, {}, [&](const ShownCell& cell) {
    std::vector<Point> corners =
        view_.visible_part({cell.corners.begin(), cell.corners.begin() + cell.width});
    for (Point& p : corners) p = view_.pixel(p);
    canvas_->add_polygon(corners);
    batches.count_one(draw);
  });
  batches.finish(draw);
}

void MeshPainter::fill(const std::vector<std::size_t>& cells, const CellPaint& paint) {
  std::vector<std::vector<std::size_t>> wide(paint.palette.size()), thin(paint.palette.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double thickness = smallest;
    if (!paint.bar) {
      for (const Edge& edge : edges_of(stream_.mesh(), cells[i], view_.scale()))
        thickness = std::min(thickness, edge.thickness);
    }
    (thickness < smallest ? thin : wide)[paint.colours[i]].push_back(cells[i]);
  }
  for (std::size_t colour = 0; colour < paint.palette.size(); ++colour) {
    fill_all(wide[colour], paint.palette[colour]);
    fill_all(thin[colour], mixed(paint.palette[colour], edge_ink, darkest));
  }
}

/// `to_left`: pixels by which the line is moved to its left.
void MeshPainter::add_line(Point from, Point to, double to_left) {
  if (to_left != 0) {
    const Point along = to - from,
                shift = to_left / (view_.scale() * length(along)) * Point{-along.y, along.x};
    from = from + shift;
    to = to + shift;
  }
  if (const auto part = view_.visible_part(from, to))
    canvas_->add_line(view_.pixel((*part)[0]), view_.pixel((*part)[1]));
}

void MeshPainter::stroke_edges(const std::vector<std::size_t>& cells, double strength) {
  std::vector<Edge> edges;
  for (const std::size_t cell : cells) {
    for (const Edge& edge : edges_of(stream_.mesh(), cell, view_.scale())) {
      if (edge.thickness >= smallest) edges.push_back(edge);
    }
  }
  const DrawnEdges drawn(stream_.communicator(), stream_.mesh(), std::move(edges));
  std::vector<std::vector<std::int32_t>> classes(width_classes);
  for (std::int32_t i = 0; i < size32(drawn.edges()); ++i) {
    const double eighths = 8 * std::log2(drawn.edges()[i].thickness / smallest);
    classes[static_cast<std::size_t>(std::clamp(eighths, 0.0, width_classes - 1.0))].push_back(i);
  }
  for (std::size_t k = 0; k < classes.size(); ++k) {
    const double thickness = smallest * std::exp2(0.125 * static_cast<double>(k));
    const double width = std::clamp(thickness / 16, 0.5, 1.1);
    const double opacity = strength * std::min(0.85, darkest * thickness / (2 * width));
    Batches batches;
    const auto draw = [&] { canvas_->stroke(edge_ink, opacity, width); };
    hand_to_root(
        stream_.communicator(), classes[k].size(),
        [&](std::size_t i) { return drawn.ends(drawn.edges()[classes[k][i]]); },
        [&](const std::array<Point, 2>& ends) {
          add_line(ends[0], ends[1]);
          batches.count_one(draw);
        });
    batches.finish(draw);
  }
}

void MeshPainter::stroke_boundary(const BoundaryEdges& boundary, Colour colour) {
  const auto place = [&](NodeId node) { return boundaries_.point(node); };
  double along = 0;
  for (const auto& [a, b] : boundary.edges) along += view_.scale() * length(place(b) - place(a));
  const double width = std::clamp(1.0 + along / (4.0 * size32(boundary.edges)), 1.7, 2.6);
  Batches batches;
  const auto draw = [&] { canvas_->stroke(colour, 1, width); };
  for (const auto& [a, b] : boundary.edges) {
    const bool has_other_side = boundary_edges_.has(place(b), place(a));
    add_line(place(a), place(b), has_other_side ? 0.5 * width : 0);
    batches.count_one(draw);
  }
  batches.finish(draw);
}

template <class Visit>
void FieldPainter::for_each_piece(const std::vector<double>& values, const Visit& visit) const {
  std::vector<LinearPiece> pieces;
  stream_.for_each(cells_, values, [&](const ShownCell& cell) {
    pieces.clear();
    append_pieces(view_, cell, pieces);
    for (const LinearPiece& piece : pieces) visit(piece);
  });
}

/// Returns the values at the pixels on the root, nothing elsewhere. *Collective.*
std::optional<ValueRaster> FieldPainter::raster_of(const std::vector<double>& values) const {
  std::optional<ValueRaster> raster;
  if (stream_.communicator().is_root()) raster.emplace(view_.frame(), resolution_);
  for_each_piece(values, [&](const LinearPiece& piece) { raster->add(piece); });
  return raster;
}

void FieldPainter::shade(const std::vector<double>& values, const ColourBar& bar) {
  const std::optional<ValueRaster> raster = raster_of(values);
  if (raster) canvas_->paint(raster->box(), raster->image(bar));
}

void FieldPainter::stroke_contours(const std::vector<double>& values, const std::vector<double>& levels) {
  Batches batches;
  const auto draw = [&] { canvas_->stroke(line_ink, 1, 1); };
  std::vector<std::array<Point, 2>> lines;
  for_each_piece(values, [&](const LinearPiece& piece) {
    lines.clear();
    append_contours(piece, levels, lines);
    for (const auto& [from, to] : lines) {
      if (const auto part = part_within(view_.frame(), from, to)) canvas_->add_line((*part)[0], (*part)[1]);
      batches.count_one(draw);
    }
  });
  batches.finish(draw);
}

void FieldPainter::stroke_streamlines(const std::vector<double>& x_velocity,
                                      const std::vector<double>& y_velocity, int count) {
  const std::optional<ValueRaster> x_raster = raster_of(x_velocity), y_raster = raster_of(y_velocity);
  if (!x_raster) return;
  const std::vector<std::vector<Point>> lines = streamlines(*x_raster, *y_raster, count);
  for (const std::vector<Point>& line : lines) canvas_->add_polyline(line);
  canvas_->stroke(line_ink, 1, 1);
  for (const std::vector<Point>& line : lines) {
    canvas_->add_polygon(arrow_on(line));
    canvas_->fill(line_ink);
  }
}

}  // namespace quadloop::io
