#include "io/plot/mesh_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "io/plot/cell_paint.hpp"
#include "io/plot/plot_view.hpp"
#include "mesher/base/error.hpp"

namespace quadloop {

namespace {

constexpr Colour edge_ink{0.13, 0.17, 0.25}, light_ink{0.93, 0.95, 1.0};
constexpr double dim = 0.2;          ///< luminance of a colour on which dark edges would not be seen
constexpr std::size_t batch = 4000;  // polygons or lines in one path
constexpr double smallest = 1.3;     // pixels between two edges that are still drawn one by one
constexpr double darkest =
    0.42;  // share of ink that edges, or the shade in their place, give an area at most
constexpr std::size_t most_boundary_names = 12;
constexpr std::size_t width_classes = 48;

/// An edge between two nodes, the lower first, and how thick a cell beside it is there, in pixels.
struct Edge {
  NodeId a, b;
  double thickness = 0;
};

Box window_of(const Mesh& mesh, const PlotOptions& options) {
  if (options.window) {
    const Box& w = *options.window;
    const bool usable =
        w.low.x < w.high.x && w.low.y < w.high.y && std::isfinite(w.width()) && std::isfinite(w.height());
    if (!usable) throw InputError("the window is empty; give it as X0,X1,Y0,Y1 with X0 < X1 and Y0 < Y1");
    return w;
  }
  Box all;
  for (const Point& p : mesh.points) all.include(p);
  if (!(all.width() > 0 && all.height() > 0))
    throw InputError("the mesh covers no area; there is nothing to plot");
  const Point margin{0.01 * std::max(all.width(), all.height()), 0.01 * std::max(all.width(), all.height())};
  return {all.low - margin, all.high + margin};
}

std::vector<Point> corners_of(const Mesh& mesh, std::size_t cell) {
  std::vector<Point> corners;
  for (const NodeId node : cell_nodes(mesh, cell)) corners.push_back(mesh.point(node));
  return corners;
}

std::vector<std::size_t> cells_in(const Mesh& mesh, const Box& window) {
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < cell_count(mesh); ++cell) {
    Box around;
    for (const NodeId node : cell_nodes(mesh, cell)) around.include(mesh.point(node));
    if (around.meets(window)) cells.push_back(cell);
  }
  if (cells.empty()) throw InputError("no cell lies in the window; choose another one");
  return cells;
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

/// Draws one mesh on one canvas, layer by layer.
class MeshPainter {
 public:
  MeshPainter(const Mesh& mesh, const PlotView& view, Canvas& canvas)
      : mesh_{mesh}, view_{view}, canvas_{canvas} {}

  void fill(const std::vector<std::size_t>& cells, const CellPaint& paint);
  void stroke_edges(const std::vector<std::size_t>& cells, Colour ink, double strength);
  void stroke_boundary(const BoundaryEdges& boundary, Colour colour);

 private:
  void fill_all(const std::vector<std::size_t>& cells, Colour colour);
  void add_line(NodeId a, NodeId b);

  const Mesh& mesh_;
  const PlotView& view_;
  Canvas& canvas_;
};

void MeshPainter::fill_all(const std::vector<std::size_t>& cells, Colour colour) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    std::vector<Point> corners = view_.visible_part(corners_of(mesh_, cells[i]));
    for (Point& p : corners) p = view_.pixel(p);
    canvas_.add_polygon(corners);
    if ((i + 1) % batch == 0 || i + 1 == cells.size()) canvas_.fill_crisp(colour);
  }
}

/// Cells too thin for their edges to be drawn are shaded instead; not where colour stands for a number.
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

void MeshPainter::add_line(NodeId a, NodeId b) {
  if (const auto part = view_.visible_part(mesh_.point(a), mesh_.point(b)))
    canvas_.add_line(view_.pixel((*part)[0]), view_.pixel((*part)[1]));
}

/// Each edge once, by the thicker of its cells; the closer edges lie, the thinner and paler they are, so that
/// a fine mesh does not turn black.
void MeshPainter::stroke_edges(const std::vector<std::size_t>& cells, Colour ink, double strength) {
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
      if ((i + 1) % batch == 0 || i + 1 == classes[k].size()) canvas_.stroke(ink, opacity, width);
    }
  }
}

/// Thinner where its edges are short: a coast drawn in bold would fill its own bays.
void MeshPainter::stroke_boundary(const BoundaryEdges& boundary, Colour colour) {
  double along = 0;
  for (const auto& [a, b] : boundary.edges) along += view_.scale() * length(mesh_.point(b) - mesh_.point(a));
  const double width = std::clamp(1.0 + along / (4.0 * size32(boundary.edges)), 1.7, 2.6);
  for (std::size_t i = 0; i < boundary.edges.size(); ++i) {
    add_line(boundary.edges[i][0], boundary.edges[i][1]);
    if ((i + 1) % batch == 0 || i + 1 == boundary.edges.size()) canvas_.stroke(colour, 1, width);
  }
}

/// The cells whose colour is too dark for dark edges, and the others.
std::array<std::vector<std::size_t>, 2> by_luminance(const std::vector<std::size_t>& cells,
                                                     const CellPaint& paint) {
  std::array<std::vector<std::size_t>, 2> parts;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto& [red, green, blue] = paint.palette[paint.colours[i]];
    const bool bright = 0.2126 * red + 0.7152 * green + 0.0722 * blue >= dim;
    parts[bright ? 1 : 0].push_back(cells[i]);
  }
  return parts;
}

Colour boundary_colour(std::size_t i) {
  static constexpr std::array<Colour, 10> colours{{{0.78, 0.11, 0.14},
                                                   {0.10, 0.36, 0.70},
                                                   {0.10, 0.52, 0.24},
                                                   {0.48, 0.23, 0.62},
                                                   {0.85, 0.44, 0.02},
                                                   {0.00, 0.55, 0.58},
                                                   {0.80, 0.22, 0.52},
                                                   {0.45, 0.29, 0.14},
                                                   {0.38, 0.45, 0.05},
                                                   {0.30, 0.34, 0.42}}};
  return colours[i % colours.size()];
}

bool is_seen(const Mesh& mesh, const BoundaryEdges& boundary, const Box& window) {
  return std::any_of(boundary.edges.begin(), boundary.edges.end(), [&](const std::array<NodeId, 2>& edge) {
    Box around;
    around.include(mesh.point(edge[0]));
    around.include(mesh.point(edge[1]));
    return around.meets(window);
  });
}

/// The boundaries that the window shows, unless they are too many to name.
void add_boundary_names(const Mesh& mesh, const Box& window, std::vector<LegendEntry>& legend) {
  std::vector<LegendEntry> names;
  for (std::size_t i = 0; i < mesh.boundaries.size(); ++i) {
    if (is_seen(mesh, mesh.boundaries[i], window))
      names.push_back({boundary_colour(i), mesh.boundaries[i].name, true});
  }
  if (names.size() <= most_boundary_names) legend.insert(legend.end(), names.begin(), names.end());
}

}  // namespace

std::string draw_mesh(const LoadedMesh& loaded, const PlotOptions& options, PlotFormat format) {
  const Mesh& mesh = loaded.mesh;
  const Box window = window_of(mesh, options);
  const std::vector<std::size_t> cells = cells_in(mesh, window);
  CellPaint paint = paint_cells(loaded, cells, options);
  add_boundary_names(mesh, window, paint.legend);
  const PlotView view(window, options.size, paint.legend, paint.bar.has_value());
  Canvas canvas(format, view.width(), view.height());
  canvas.clip(view.frame());
  MeshPainter painter(mesh, view, canvas);
  painter.fill(cells, paint);
  if (paint.bar) {
    const auto [dark, bright] = by_luminance(cells, paint);
    painter.stroke_edges(dark, light_ink, 0.3);
    painter.stroke_edges(bright, edge_ink, 0.55);
  } else {
    painter.stroke_edges(cells, edge_ink, 1);
  }
  for (std::size_t i = 0; i < mesh.boundaries.size(); ++i)
    painter.stroke_boundary(mesh.boundaries[i], boundary_colour(i));
  canvas.unclip();
  view.draw_axes(canvas);
  view.draw_legend(canvas, paint.legend);
  if (paint.bar) view.draw_bar(canvas, *paint.bar);
  return canvas.finish();
}

}  // namespace quadloop
