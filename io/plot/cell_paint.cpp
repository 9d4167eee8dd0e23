#include "io/plot/cell_paint.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "io/plot/canvas/colour_map.hpp"
#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/mesh/check/quality.hpp"
#include "mesher/mesh/halo_mesh.hpp"
#include "mesher/mesh/node_exchange.hpp"

namespace quadloop::io {

namespace {

constexpr std::size_t bar_colours = 256;
constexpr std::size_t most_block_names = 12;

CellPaint paint_types(const Communicator& comm, const LoadedMesh& loaded,
                      const std::vector<std::size_t>& cells) {
  CellPaint paint;
  paint.palette = {{1.0, 0.855, 0.71}, {0.835, 0.905, 0.975}};
  for (const std::size_t cell : cells) paint.colours.push_back(cell < loaded.mesh.triangles.size() ? 0 : 1);
  if (comm.any(std::ranges::count(paint.colours, 1) > 0)) paint.legend.push_back({paint.palette[1], "quads"});
  if (comm.any(std::ranges::count(paint.colours, 0) > 0))
    paint.legend.push_back({paint.palette[0], "triangles"});
  return paint;
}

std::size_t block_of(const LoadedMesh& loaded, std::size_t cell) {
  const std::size_t triangles = loaded.mesh.triangles.size();
  const auto& blocks = cell < triangles ? loaded.triangle_to_block : loaded.quad_to_block;
  const std::size_t i = cell < triangles ? cell : cell - triangles;
  return i < blocks.size() ? static_cast<std::size_t>(blocks[i]) : 0;
}

/// Returns the values of all ranks, each once, ascending. *Collective.*
std::vector<std::size_t> each_once(const Communicator& comm, std::vector<std::size_t> values) {
  const auto make_unique = [&] {
    std::ranges::sort(values);
    values.erase(std::unique(values.begin(), values.end()), values.end());
  };
  make_unique();
  values = comm.all_gather_values(std::span<const std::size_t>(values));
  make_unique();
  return values;
}

CellPaint paint_blocks(const Communicator& comm, const LoadedMesh& loaded,
                       const std::vector<std::size_t>& cells) {
  CellPaint paint;
  paint.palette = {{0.78, 0.87, 0.96}, {0.99, 0.86, 0.72}, {0.80, 0.92, 0.77}, {0.95, 0.79, 0.80},
                   {0.87, 0.82, 0.94}, {0.98, 0.95, 0.72}, {0.76, 0.92, 0.91}, {0.90, 0.87, 0.82}};
  std::vector<std::size_t> seen;
  for (const std::size_t cell : cells) {
    const std::size_t block = block_of(loaded, cell);
    paint.colours.push_back(static_cast<std::uint16_t>(block % paint.palette.size()));
    if (seen.empty() || seen.back() != block) seen.push_back(block);
  }
  seen = each_once(comm, std::move(seen));
  if (seen.size() > most_block_names) return paint;
  for (const std::size_t block : seen) {
    const bool named = block < loaded.block_names.size() && !loaded.block_names[block].empty();
    paint.legend.push_back({paint.palette[block % paint.palette.size()],
                            named ? loaded.block_names[block] : "block " + std::to_string(block + 1)});
  }
  return paint;
}

/// Values that are not finite (a diverged solution) are grey.
CellPaint paint_values(const std::vector<double>& values, const ColourBar& bar) {
  CellPaint paint;
  for (std::size_t i = 0; i < bar_colours; ++i)
    paint.palette.push_back(bar.colour((static_cast<double>(i) + 0.5) / bar_colours));
  paint.palette.push_back({0.6, 0.6, 0.6});
  for (const double value : values) {
    const double t = std::clamp((value - bar.low) / (bar.high - bar.low), 0.0, 1.0);
    const auto colour = std::isfinite(value)
                            ? std::min(static_cast<std::size_t>(t * bar_colours), bar_colours - 1)
                            : bar_colours;
    paint.colours.push_back(static_cast<std::uint16_t>(colour));
  }
  paint.bar = bar;
  return paint;
}

CellPaint paint_quality(const LoadedMesh& loaded, const std::vector<std::size_t>& cells) {
  std::vector<double> values;
  for (const std::size_t cell : cells) {
    std::array<Point, 4> corners;
    const std::span<const NodeId> nodes = cell_nodes(loaded.mesh, cell);
    std::transform(nodes.begin(), nodes.end(), corners.begin(),
                   [&](NodeId node) { return loaded.mesh.point(node); });
    values.push_back(quality_of(std::span(corners).first(nodes.size())));
  }
  return paint_values(values, {"quality", 0, 1, quality_colour});
}

/// Sets the requested range, else that of the values, or one around a constant value.
void settle_range(ColourBar& bar, const PlotOptions& options) {
  if (options.range) {
    bar.low = (*options.range)[0];
    bar.high = (*options.range)[1];
    return;
  }
  if (bar.low > bar.high) bar.low = bar.high = 0;
  const double least = 1e-9 * std::max(std::abs(bar.low), std::abs(bar.high));
  if (bar.high - bar.low > least) return;
  const double around = least > 0 ? 1e-3 * std::abs(bar.low) : 1;
  bar.low -= around;
  bar.high += around;
}

/// Averages nodal values to cells.
std::vector<double> means_of_corners(const Mesh& mesh, const std::vector<double>& of_nodes) {
  std::vector<double> means;
  for (std::size_t cell = 0; cell < cell_count(mesh); ++cell) {
    double sum = 0;
    for (const NodeId node : cell_nodes(mesh, cell)) sum += of_nodes[node.value()];
    means.push_back(sum / size32(cell_nodes(mesh, cell)));
  }
  return means;
}

/// Throws InputError for an unknown name.
ColourMap colour_map_of(const PlotOptions& options) {
  const ColourMap map = colour_map_named(options.map);
  if (map != nullptr) return map;
  throw InputError(
      fmt::format("'{}' is no colour map; these are {}", options.map, fmt::join(colour_map_names(), ", ")));
}

CellPaint paint_field(const Communicator& comm, const LoadedMesh& loaded,
                      const std::vector<std::size_t>& cells, const PlotOptions& options) {
  const FieldValues field = field_values(comm, loaded, options.field);
  ColourBar bar{options.field, std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(), colour_map_of(options)};
  const auto include = [&](double value) {
    if (!std::isfinite(value)) return;
    bar.low = std::min(bar.low, value);
    bar.high = std::max(bar.high, value);
  };
  std::vector<double> values;
  for (const std::size_t cell : cells) {
    values.push_back(field.of_cells[cell]);
    if (!options.smooth) include(values.back());
    if (!options.smooth) continue;
    for (const NodeId node : cell_nodes(loaded.mesh, cell)) include(field.of_nodes[node.value()]);
  }
  bar.low = comm.minimum(bar.low);
  bar.high = comm.maximum(bar.high);
  settle_range(bar, options);
  return paint_values(values, bar);
}

}  // namespace

std::vector<double> with_ghost_values(const Communicator& comm, const Mesh& mesh,
                                      std::vector<double> values) {
  values.resize(mesh.points.size());
  NodeExchange(comm, NodeOwners(comm, mesh.first_node), mesh.owned_nodes, mesh.ghosts).update(values);
  return values;
}

std::vector<double> means_at_nodes(const Communicator& comm, const Mesh& mesh,
                                   const std::vector<double>& of_cells) {
  const HaloMesh halo(comm, mesh);
  const std::vector<double> of_halo = halo.spread(comm, of_cells);
  std::vector<double> sums(mesh.owned_nodes, 0);
  std::vector<std::int32_t> counts(sums.size(), 0);
  auto value = of_halo.begin();
  halo.for_each_cell([&](const auto& nodes) {
    for (const NodeId node : nodes) {
      if (!mesh.owns(node)) continue;
      sums[node.value()] += *value;
      ++counts[node.value()];
    }
    ++value;
  });
  for (std::size_t node = 0; node < sums.size(); ++node) sums[node] /= std::max(counts[node], 1);
  return with_ghost_values(comm, mesh, std::move(sums));
}

FieldValues field_values(const Communicator& comm, const LoadedMesh& loaded, const std::string& field) {
  if (!loaded.solution || loaded.solution->empty())
    throw InputError("there is no field '" + field +
                     "': the file holds no solution; plot it without --field");
  const std::vector<std::string>&names = loaded.solution->names, &of_cells = loaded.solution->cells.names;
  const Mesh& mesh = loaded.mesh;
  if (const auto found = std::ranges::find(names, field); found != names.end()) {
    std::vector<double> values =
        with_ghost_values(comm, mesh, loaded.solution->column(found - names.begin()));
    return {values, means_of_corners(mesh, values)};
  }
  if (const auto found = std::ranges::find(of_cells, field); found != of_cells.end()) {
    std::vector<double> values = loaded.solution->cells.column(found - of_cells.begin());
    return {means_at_nodes(comm, mesh, values), values};
  }
  std::vector<std::string> all = names;
  all.insert(all.end(), of_cells.begin(), of_cells.end());
  throw InputError(fmt::format("there is no field '{}'; there are: {}{}", field, fmt::join(all, ", "),
                               guess_for(field, all)));
}

std::size_t cell_count(const Mesh& mesh) { return mesh.cell_count(); }

std::span<const NodeId> cell_nodes(const Mesh& mesh, std::size_t cell) {
  if (cell < mesh.triangles.size()) return mesh.triangles[cell];
  return mesh.quads[cell - mesh.triangles.size()];
}

CellPaint paint_cells(const Communicator& comm, const LoadedMesh& loaded,
                      const std::vector<std::size_t>& cells, const PlotOptions& options) {
  if (!options.field.empty()) return paint_field(comm, loaded, cells, options);
  if (options.colouring == PlotColouring::quality) return paint_quality(loaded, cells);
  return options.colouring == PlotColouring::block ? paint_blocks(comm, loaded, cells)
                                                   : paint_types(comm, loaded, cells);
}

}  // namespace quadloop::io
