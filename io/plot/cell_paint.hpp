#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "io/plot/mesh_plot.hpp"
#include "io/plot/plot_view.hpp"

namespace quadloop::io {

/// Number of cells, and nodes of a cell; triangles come before quads.
std::size_t cell_count(const Mesh& mesh);
std::span<const NodeId> cell_nodes(const Mesh& mesh, std::size_t cell);

/// A colour for each of some cells, with the legend.
struct CellPaint {
  std::vector<Colour> palette;
  std::vector<std::uint16_t> colours;  ///< indices into palette, one for each cell of the list
  std::vector<LegendEntry> legend;
  std::optional<ColourBar> bar;
};

/// A variable of the solution, at nodes and in cells (cell_nodes()): values that the file lacks are averaged
/// from the others.
struct FieldValues {
  std::vector<double> of_nodes, of_cells;
};
/// Throws InputError if there is no variable of this name.
FieldValues field_values(const LoadedMesh& loaded, const std::string& field);

/// Colours `cells` (numbers as for cell_nodes). Throws InputError if the field does not exist.
CellPaint paint_cells(const LoadedMesh& loaded, const std::vector<std::size_t>& cells,
                      const PlotOptions& options);

}  // namespace quadloop::io
