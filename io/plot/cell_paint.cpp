#include "io/plot/cell_paint.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "mesher/base/error.hpp"
#include "mesher/base/nearest_word.hpp"
#include "mesher/mesh/check/quality.hpp"

namespace quadloop {

namespace {

constexpr std::size_t bar_colours = 256;
constexpr std::size_t most_block_names = 12;

CellPaint paint_types(const LoadedMesh& loaded, const std::vector<std::size_t>& cells) {
  CellPaint paint;
  paint.palette = {{1.0, 0.855, 0.71}, {0.835, 0.905, 0.975}};
  for (const std::size_t cell : cells) paint.colours.push_back(cell < loaded.mesh.triangles.size() ? 0 : 1);
  if (std::count(paint.colours.begin(), paint.colours.end(), 1) > 0)
    paint.legend.push_back({paint.palette[1], "quads"});
  if (std::count(paint.colours.begin(), paint.colours.end(), 0) > 0)
    paint.legend.push_back({paint.palette[0], "triangles"});
  return paint;
}

std::size_t block_of(const LoadedMesh& loaded, std::size_t cell) {
  const std::size_t triangles = loaded.mesh.triangles.size();
  const auto& blocks = cell < triangles ? loaded.triangle_to_block : loaded.quad_to_block;
  const std::size_t i = cell < triangles ? cell : cell - triangles;
  return i < blocks.size() ? static_cast<std::size_t>(blocks[i]) : 0;
}

CellPaint paint_blocks(const LoadedMesh& loaded, const std::vector<std::size_t>& cells) {
  CellPaint paint;
  paint.palette = {{0.78, 0.87, 0.96}, {0.99, 0.86, 0.72}, {0.80, 0.92, 0.77}, {0.95, 0.79, 0.80},
                   {0.87, 0.82, 0.94}, {0.98, 0.95, 0.72}, {0.76, 0.92, 0.91}, {0.90, 0.87, 0.82}};
  std::vector<std::size_t> seen;
  for (const std::size_t cell : cells) {
    const std::size_t block = block_of(loaded, cell);
    paint.colours.push_back(static_cast<std::uint16_t>(block % paint.palette.size()));
    if (seen.empty() || seen.back() != block) seen.push_back(block);
  }
  std::sort(seen.begin(), seen.end());
  seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
  if (seen.size() > most_block_names) return paint;
  for (const std::size_t block : seen) {
    const bool named = block < loaded.block_names.size() && !loaded.block_names[block].empty();
    paint.legend.push_back({paint.palette[block % paint.palette.size()],
                            named ? loaded.block_names[block] : "block " + std::to_string(block + 1)});
  }
  return paint;
}

/// Numbers that are not finite (a diverged solution) are grey.
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

/// The range that is asked for; else the values', or one round a value that is the same all over.
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

CellPaint paint_field(const LoadedMesh& loaded, const std::vector<std::size_t>& cells,
                      const PlotOptions& options) {
  const std::size_t column = field_column(loaded, options.field), columns = loaded.solution->names.size();
  ColourBar bar{options.field, std::numeric_limits<double>::infinity(),
                -std::numeric_limits<double>::infinity(), options.map};
  std::vector<double> values;
  for (const std::size_t cell : cells) {
    double sum = 0;
    const std::span<const NodeId> nodes = cell_nodes(loaded.mesh, cell);
    for (const NodeId node : nodes) {
      const double value = loaded.solution->values[node.value() * columns + column];
      sum += value;
      if (!options.smooth || !std::isfinite(value)) continue;
      bar.low = std::min(bar.low, value);
      bar.high = std::max(bar.high, value);
    }
    values.push_back(sum / size32(nodes));
    if (options.smooth || !std::isfinite(values.back())) continue;
    bar.low = std::min(bar.low, values.back());
    bar.high = std::max(bar.high, values.back());
  }
  settle_range(bar, options);
  return paint_values(values, bar);
}

}  // namespace

std::size_t field_column(const LoadedMesh& loaded, const std::string& field) {
  if (!loaded.solution || loaded.solution->names.empty())
    throw InputError("there is no field '" + field +
                     "': the file holds no solution; plot it without --field");
  const std::vector<std::string>& names = loaded.solution->names;
  const auto found = std::find(names.begin(), names.end(), field);
  if (found != names.end()) return found - names.begin();
  std::string there;
  for (const std::string& name : names) there += (there.empty() ? "" : ", ") + name;
  throw InputError("there is no field '" + field + "'; there are: " + there + guess_for(field, names));
}

std::size_t cell_count(const Mesh& mesh) { return mesh.triangles.size() + mesh.quads.size(); }

std::span<const NodeId> cell_nodes(const Mesh& mesh, std::size_t cell) {
  if (cell < mesh.triangles.size()) return mesh.triangles[cell];
  return mesh.quads[cell - mesh.triangles.size()];
}

CellPaint paint_cells(const LoadedMesh& loaded, const std::vector<std::size_t>& cells,
                      const PlotOptions& options) {
  if (!options.field.empty()) return paint_field(loaded, cells, options);
  if (options.colouring == PlotColouring::quality) return paint_quality(loaded, cells);
  return options.colouring == PlotColouring::block ? paint_blocks(loaded, cells) : paint_types(loaded, cells);
}

}  // namespace quadloop
