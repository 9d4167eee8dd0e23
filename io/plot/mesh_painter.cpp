#include "io/plot/mesh_painter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include "io/plot/contour_lines.hpp"
#include "io/plot/streamlines.hpp"
#include "io/plot/value_raster.hpp"

namespace quadloop::io {

namespace {

constexpr Colour edge_ink{0.13, 0.17, 0.25}, line_ink{0.08, 0.08, 0.1};
constexpr std::size_t batch = 4000;  // polygons or lines per path
constexpr double smallest = 1.3;     // pixels between two edges that are still drawn individually
constexpr double darkest = 0.42;     // maximum fraction of ink in an area with edges, or with shading instead
constexpr std::size_t width_classes = 48;

/// An edge between two nodes, the lower first, with the thickness in pixels of an adjacent cell.
struct Edge {
  NodeId a, b;
  double thickness = 0;
};

std::vector<Point> corners_of(const Mesh& mesh, std::size_t cell) {
  std::vector<Point> corners;
  for (const NodeId node : cell_nodes(mesh, cell)) corners.push_back(mesh.point(node));
  return corners;
}

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
    const auto [a, b] = std::minmax(nodes[i], nodes[(i + 1) % nodes.size()]);
    const double along = length(mesh.point(b) - mesh.point(a));
    edges.push_back({a, b, along > 0 ? scale * area / along : 0});
  }
  return edges;
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

PlacedEdges::PlacedEdges(const Mesh& mesh) {
  for (const BoundaryEdges& boundary : mesh.boundaries) {
    for (const auto& [from, to] : boundary.edges) places_.push_back({mesh.point(from), mesh.point(to)});
  }
  std::ranges::sort(places_);
}

void MeshPainter::fill_all(const std::vector<std::size_t>& cells, Colour colour) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<Point> corners = view_.visible_part(corners_of(mesh_, cells[i]));
    for (Point& p : corners) p = view_.pixel(p);
    canvas_.add_polygon(corners);
    if ((i + 1) % batch == 0 || i + 1 == cells.size()) canvas_.fill_crisp(colour);
  }
}

void MeshPainter::fill(const std::vector<std::size_t>& cells, const CellPaint& paint) {
  std::vector<std::vector<std::size_t>> wide(paint.palette.size()), thin(paint.palette.size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    double thickness = smallest;
    if (!paint.bar) {
      for (const Edge& edge : edges_of(mesh_, cells[i], view_.scale()))
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
void MeshPainter::add_line(NodeId a, NodeId b, double to_left) {
  Point from = mesh_.point(a), to = mesh_.point(b);
  if (to_left != 0) {
    const Point along = to - from,
                shift = to_left / (view_.scale() * length(along)) * Point{-along.y, along.x};
    from = from + shift;
    to = to + shift;
  }
  if (const auto part = view_.visible_part(from, to))
    canvas_.add_line(view_.pixel((*part)[0]), view_.pixel((*part)[1]));
}

void MeshPainter::stroke_edges(const std::vector<std::size_t>& cells, double strength) {
  std::vector<Edge> edges;
  for (const std::size_t cell : cells) {
    for (const Edge& edge : edges_of(mesh_, cell, view_.scale())) {
      if (edge.thickness >= smallest) edges.push_back(edge);
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& p, const Edge& q) {
    return std::tuple(p.a, p.b, q.thickness) < std::tuple(q.a, q.b, p.thickness);
  });
  edges.erase(std::unique(edges.begin(), edges.end(),
                          [](const Edge& p, const Edge& q) { return p.a == q.a && p.b == q.b; }),
              edges.end());
  std::vector<std::vector<std::size_t>> classes(width_classes);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const double eighths = 8 * std::log2(edges[i].thickness / smallest);
    classes[static_cast<std::size_t>(std::clamp(eighths, 0.0, width_classes - 1.0))].push_back(i);
  }
  for (std::size_t k = 0; k < classes.size(); ++k) {
    const double thickness = smallest * std::exp2(0.125 * static_cast<double>(k));
    const double width = std::clamp(thickness / 16, 0.5, 1.1);
    const double opacity = strength * std::min(0.85, darkest * thickness / (2 * width));
    for (std::size_t i = 0; i < classes[k].size(); ++i) {
      add_line(edges[classes[k][i]].a, edges[classes[k][i]].b);
      if ((i + 1) % batch == 0 || i + 1 == classes[k].size()) canvas_.stroke(edge_ink, opacity, width);
    }
  }
}

void MeshPainter::stroke_boundary(const BoundaryEdges& boundary, Colour colour) {
  double along = 0;
  for (const auto& [a, b] : boundary.edges) along += view_.scale() * length(mesh_.point(b) - mesh_.point(a));
  const double width = std::clamp(1.0 + along / (4.0 * size32(boundary.edges)), 1.7, 2.6);
  for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
    const auto [a, b] = boundary.edges[i];
    const bool has_other_side = boundary_edges_.has(mesh_.point(b), mesh_.point(a));
    add_line(a, b, has_other_side ? 0.5 * width : 0);
    if ((i + 1) % batch == 0 || i + 1 == boundary.edges.size()) canvas_.stroke(colour, 1, width);
  }
}

ValueRaster FieldPainter::raster_of(const std::vector<double>& values) const {
  ValueRaster raster(view_.frame(), resolution_);
  std::vector<LinearPiece> pieces;
  for (const std::size_t cell : cells_) {
    pieces.clear();
    append_pieces(mesh_, view_, cell, values, pieces);
    for (const LinearPiece& piece : pieces) raster.add(piece);
  }
  return raster;
}

void FieldPainter::shade(const std::vector<double>& values, const ColourBar& bar) {
  const ValueRaster raster = raster_of(values);
  canvas_.paint(raster.box(), raster.image(bar));
}

void FieldPainter::stroke_contours(const std::vector<double>& values, const std::vector<double>& levels) {
  std::vector<std::array<Point, 2>> lines;
  std::vector<LinearPiece> pieces;
  for (const std::size_t cell : cells_) {
    pieces.clear();
    append_pieces(mesh_, view_, cell, values, pieces);
    for (const LinearPiece& piece : pieces) append_contours(piece, levels, lines);
  }
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (const auto part = part_within(view_.frame(), lines[i][0], lines[i][1]))
      canvas_.add_line((*part)[0], (*part)[1]);
    if ((i + 1) % batch == 0 || i + 1 == lines.size()) canvas_.stroke(line_ink, 1, 1);
  }
}

void FieldPainter::stroke_streamlines(const std::vector<double>& x_velocity,
                                      const std::vector<double>& y_velocity, int count) {
  const std::vector<std::vector<Point>> lines =
      streamlines(raster_of(x_velocity), raster_of(y_velocity), count);
  for (const std::vector<Point>& line : lines) canvas_.add_polyline(line);
  canvas_.stroke(line_ink, 1, 1);
  for (const std::vector<Point>& line : lines) {
    canvas_.add_polygon(arrow_on(line));
    canvas_.fill(line_ink);
  }
}

}  // namespace quadloop::io
