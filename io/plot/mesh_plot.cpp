#include "io/plot/mesh_plot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "io/plot/canvas/sheet.hpp"
#include "io/plot/cell_paint.hpp"
#include "io/plot/contour_lines.hpp"
#include "io/plot/mesh_painter.hpp"
#include "io/plot/plot_view.hpp"
#include "mesher/base/error.hpp"
#include "mesher/mesh/box_over_ranks.hpp"
#include "mesher/mesh/scatter_mesh.hpp"
#include "mesher/mesh/variable_names.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t most_boundary_names = 12;

Box window_of(const Communicator& comm, const Mesh& mesh, const PlotOptions& options) {
  if (options.window) {
    const Box& w = *options.window;
    const bool usable =
        w.low.x < w.high.x && w.low.y < w.high.y && std::isfinite(w.width()) && std::isfinite(w.height());
    if (!usable) throw InputError("the window is empty; give it as X0,X1,Y0,Y1 with X0 < X1 and Y0 < Y1");
    return w;
  }
  const Box all = box_over_ranks(comm, mesh.points);
  if (!(all.width() > 0 && all.height() > 0))
    throw InputError("the mesh covers no area; there is nothing to plot");
  const Point margin{0.01 * std::max(all.width(), all.height()), 0.01 * std::max(all.width(), all.height())};
  return {all.low - margin, all.high + margin};
}

/// Returns this rank's cells in the window. *Collective.*
std::vector<std::size_t> cells_in(const Communicator& comm, const Mesh& mesh, const Box& window) {
  std::vector<std::size_t> cells;
  for (std::size_t cell = 0; cell < cell_count(mesh); ++cell) {
    Box around;
    for (const NodeId node : cell_nodes(mesh, cell)) around.include(mesh.point(node));
    if (around.meets(window)) cells.push_back(cell);
  }
  if (!comm.any(!cells.empty())) throw InputError("no cell lies in the window; choose another one");
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

/// Adds the boundaries within the window, unless there are too many. *Collective.*
void add_boundary_names(const Communicator& comm, const Mesh& mesh, const Box& window,
                        std::vector<LegendEntry>& legend) {
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < mesh.boundaries.size(); ++i) {
    if (is_seen(mesh, mesh.boundaries[i], window)) own.push_back(i);
  }
  std::vector<char> seen(mesh.boundaries.size(), 0);
  for (const std::size_t i : comm.all_gather_values(std::span<const std::size_t>(own))) seen[i] = 1;
  std::vector<LegendEntry> names;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (seen[i] != 0) names.push_back({boundary_colour(i), mesh.boundaries[i].name, true});
  }
  if (names.size() <= most_boundary_names) legend.insert(legend.end(), names.begin(), names.end());
}

/// Returns a velocity component by node, from the nodal variables, else from those in cells. *Collective.*
std::vector<double> velocity_part(const Communicator& comm, const LoadedMesh& loaded, const char* name) {
  const Field& solution = *loaded.solution;
  const CellValues& cells = solution.cells;
  if (variables_like(solution.names, name).empty() && !variables_like(cells.names, name).empty())
    return means_at_nodes(comm, loaded.mesh,
                          cells.column(variable(cells.names, name, "streamlines need a velocity")));
  std::vector<std::string> all = solution.names;
  if (all.empty()) all = cells.names;  // for the message
  return with_ghost_values(comm, loaded.mesh,
                           solution.column(variable(all, name, "streamlines need a velocity")));
}

/// The fields shown in a picture, by node.
struct ShownFields {
  std::vector<double> field, x_velocity, y_velocity;
};

ShownFields shown_fields(const Communicator& comm, const LoadedMesh& loaded, const PlotOptions& options) {
  ShownFields shown;
  if (!options.field.empty()) shown.field = field_values(comm, loaded, options.field).of_nodes;
  if (options.streamlines > 0) {
    if (!loaded.solution) throw InputError("streamlines need a velocity, but the file holds no solution");
    shown.x_velocity = velocity_part(comm, loaded, "x_velocity");
    shown.y_velocity = velocity_part(comm, loaded, "y_velocity");
  }
  return shown;
}

class Picture {
 public:
  Picture(const Communicator& comm, const LoadedMesh& loaded, const PlotOptions& options, PlotFormat format)
      : comm_{comm},
        loaded_{loaded},
        options_{options},
        format_{format},
        sheet_{sheet_of(options.centimetres, format)} {}

  /// *Collective.*
  std::string draw() const {
    const Mesh& mesh = loaded_.mesh;
    const bool has_bar = !options_.field.empty() || options_.colouring == PlotColouring::quality;
    Box window = window_of(comm_, mesh, options_);
    if (sheet_.size) window = PlotView::filling(window, *sheet_.size, has_bar);
    const std::vector<std::size_t> cells = cells_in(comm_, mesh, window);
    CellPaint paint = paint_cells(comm_, loaded_, cells, options_);
    const ShownFields shown = shown_fields(comm_, loaded_, options_);
    add_boundary_names(comm_, mesh, window, paint.legend);
    const PlotView view(window, options_.size, paint.legend, has_bar, sheet_.size);
    const CellStream stream(comm_, mesh);
    const FieldPainter fields(stream, cells, view, sheet_.resolution);
    const std::vector<Layer> layers = layers_of(stream, fields, view, cells, paint, shown);
    return drawn(layers, view, paint);
  }

 private:
  /// A layer of the picture. *Collective.*
  using Layer = std::function<void(const ShownStrip& strip)>;

  /// The layers from the lowest one; they refer to the arguments. *Collective.*
  std::vector<Layer> layers_of(const CellStream& stream, const FieldPainter& fields, const PlotView& view,
                               const std::vector<std::size_t>& cells, const CellPaint& paint,
                               const ShownFields& shown) const {
    const auto drawing = [](auto layer) {
      return [layer = std::move(layer)](const ShownStrip& strip) { layer.draw(strip); };
    };
    const bool has_field = !options_.field.empty();
    std::vector<Layer> layers;
    if (has_field && options_.smooth) {
      layers.emplace_back([&](const ShownStrip& strip) { fields.shade(strip, shown.field, *paint.bar); });
    } else {
      layers.emplace_back(drawing(CellLayer(stream, view, cells, paint)));
    }
    if (options_.lines.value_or(!has_field))
      layers.emplace_back(drawing(EdgeLayer(stream, view, cells, paint.bar ? 0.55 : 1)));
    if (has_field && options_.contours > 0) {
      const std::vector<double> levels = contour_levels(paint.bar->low, paint.bar->high, options_.contours);
      layers.emplace_back([&fields, &shown, levels](const ShownStrip& strip) {
        fields.stroke_contours(strip, shown.field, levels);
      });
    }
    if (options_.streamlines > 0) {
      const auto lines = fields.streamlines(shown.x_velocity, shown.y_velocity, options_.streamlines);
      layers.emplace_back([lines](const ShownStrip& strip) {
        if (strip.canvas != nullptr) stroke_streamlines(*strip.canvas, lines);
      });
    }
    layers.emplace_back(
        drawing(BoundaryLayer(gather_boundaries(comm_, loaded_.mesh), view, boundary_colour)));
    return layers;
  }

  /// Returns the file's bytes on the root, none elsewhere. *Collective.*
  std::string drawn(const std::vector<Layer>& layers, const PlotView& view, const CellPaint& paint) const {
    const Strips strips(format_, view.width(), view.height(), sheet_.scale);
    std::optional<Canvas> canvas;
    if (comm_.is_root()) canvas.emplace(strips);
    std::string bytes;
    for (int i = 0; i < strips.count(); ++i) {
      const ShownStrip strip{canvas ? &*canvas : nullptr, strips.part(i)};
      if (canvas) canvas->clip(view.frame());
      for (const Layer& layer : layers) layer(strip);
      comm_.together([&] {
        if (!canvas) return;
        draw_beside(*canvas, view, paint);
        if (i + 1 < strips.count())
          canvas->next_strip();
        else
          bytes = canvas->finish();
      });
    }
    return bytes;
  }

  /// Draws what is outside of the frame.
  static void draw_beside(Canvas& canvas, const PlotView& view, const CellPaint& paint) {
    canvas.unclip();
    view.draw_axes(canvas, "x", "y");
    view.draw_legend(canvas, paint.legend);
    if (paint.bar) view.draw_bar(canvas, *paint.bar);
  }

  const Communicator& comm_;
  const LoadedMesh& loaded_;
  const PlotOptions& options_;
  PlotFormat format_;
  Sheet sheet_;
};

}  // namespace

std::string draw_mesh(const Communicator& comm, const LoadedMesh& loaded, const PlotOptions& options,
                      PlotFormat format) {
  return Picture(comm, loaded, options, format).draw();
}

}  // namespace quadloop::io
