#include "io/plot/mesh_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "io/plot/canvas/sheet.hpp"
#include "io/plot/cell_paint.hpp"
#include "io/plot/contour_lines.hpp"
#include "io/plot/mesh_painter.hpp"
#include "io/plot/plot_view.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t most_boundary_names = 12;

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

/// Adds the boundaries within the window, unless there are too many.
void add_boundary_names(const Mesh& mesh, const Box& window, std::vector<LegendEntry>& legend) {
  std::vector<LegendEntry> names;
  for (std::size_t i = 0; i < mesh.boundaries.size(); ++i) {
    if (is_seen(mesh, mesh.boundaries[i], window))
      names.push_back({boundary_colour(i), mesh.boundaries[i].name, true});
  }
  if (names.size() <= most_boundary_names) legend.insert(legend.end(), names.begin(), names.end());
}

/// Averages the cells around each node.
std::vector<double> at_nodes(const Mesh& mesh, const std::vector<double>& of_cells) {
  std::vector<double> sums(mesh.points.size(), 0);
  std::vector<int> counts(mesh.points.size(), 0);
  for (std::size_t cell = 0; cell < of_cells.size(); ++cell) {
    for (const NodeId node : cell_nodes(mesh, cell)) {
      sums[node.value()] += of_cells[cell];
      ++counts[node.value()];
    }
  }
  for (std::size_t node = 0; node < sums.size(); ++node) sums[node] /= std::max(counts[node], 1);
  return sums;
}

/// Returns a velocity component by node, from the nodal variables, else from those in cells.
std::vector<double> velocity_part(const LoadedMesh& loaded, const char* name) {
  const Field& solution = *loaded.solution;
  const CellValues& cells = solution.cells;
  if (variables_like(solution.names, name).empty() && !variables_like(cells.names, name).empty())
    return at_nodes(loaded.mesh, cells.column(variable(cells.names, name, "streamlines need a velocity")));
  std::vector<std::string> all = solution.names;
  if (all.empty()) all = cells.names;  // for the message
  return solution.column(variable(all, name, "streamlines need a velocity"));
}

/// The fields shown in a picture, by node.
struct ShownFields {
  std::vector<double> field, x_velocity, y_velocity;
};

ShownFields shown_fields(const LoadedMesh& loaded, const PlotOptions& options) {
  ShownFields shown;
  if (!options.field.empty()) shown.field = field_values(loaded, options.field).of_nodes;
  if (options.streamlines > 0) {
    if (!loaded.solution) throw InputError("streamlines need a velocity, but the file holds no solution");
    shown.x_velocity = velocity_part(loaded, "x_velocity");
    shown.y_velocity = velocity_part(loaded, "y_velocity");
  }
  return shown;
}

class Picture {
 public:
  Picture(const LoadedMesh& loaded, const PlotOptions& options, PlotFormat format)
      : loaded_{loaded}, options_{options}, format_{format}, sheet_{sheet_of(options.centimetres, format)} {}

  std::string draw() const {
    const Mesh& mesh = loaded_.mesh;
    const bool has_bar = !options_.field.empty() || options_.colouring == PlotColouring::quality;
    Box window = window_of(mesh, options_);
    if (sheet_.size) window = PlotView::filling(window, *sheet_.size, has_bar);
    const std::vector<std::size_t> cells = cells_in(mesh, window);
    CellPaint paint = paint_cells(loaded_, cells, options_);
    const ShownFields shown = shown_fields(loaded_, options_);
    add_boundary_names(mesh, window, paint.legend);
    const PlotView view(window, options_.size, paint.legend, has_bar, sheet_.size);
    Canvas canvas(format_, view.width(), view.height(), sheet_.scale);
    canvas.clip(view.frame());
    draw_cells(cells, paint, shown, view, canvas);
    canvas.unclip();
    view.draw_axes(canvas, "x", "y");
    view.draw_legend(canvas, paint.legend);
    if (paint.bar) view.draw_bar(canvas, *paint.bar);
    return canvas.finish();
  }

 private:
  void draw_cells(const std::vector<std::size_t>& cells, const CellPaint& paint, const ShownFields& shown,
                  const PlotView& view, Canvas& canvas) const {
    const bool has_field = !options_.field.empty();
    MeshPainter painter(loaded_.mesh, view, canvas);
    FieldPainter fields(loaded_.mesh, cells, view, canvas, sheet_.resolution);
    if (has_field && options_.smooth) {
      fields.shade(shown.field, *paint.bar);
    } else {
      painter.fill(cells, paint);
    }
    if (options_.lines.value_or(!has_field)) painter.stroke_edges(cells, paint.bar ? 0.55 : 1);
    if (has_field && options_.contours > 0)
      fields.stroke_contours(shown.field, contour_levels(paint.bar->low, paint.bar->high, options_.contours));
    if (options_.streamlines > 0)
      fields.stroke_streamlines(shown.x_velocity, shown.y_velocity, options_.streamlines);
    for (std::size_t i = 0; i < loaded_.mesh.boundaries.size(); ++i)
      painter.stroke_boundary(loaded_.mesh.boundaries[i], boundary_colour(i));
  }

  const LoadedMesh& loaded_;
  const PlotOptions& options_;
  PlotFormat format_;
  Sheet sheet_;
};

}  // namespace

std::string draw_mesh(const LoadedMesh& loaded, const PlotOptions& options, PlotFormat format) {
  return Picture(loaded, options, format).draw();
}

}  // namespace quadloop::io
