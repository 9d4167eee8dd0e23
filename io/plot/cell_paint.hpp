#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/model/loaded_mesh.hpp"
#include "io/plot/mesh_plot.hpp"
#include "io/plot/plot_view.hpp"
#include "mesher/base/parallel/communicator.hpp"

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

/// A variable of the solution, at this rank's nodes and ghosts and in its cells (cell_nodes()): values that
/// the file lacks are averaged from the others.
struct FieldValues {
  std::vector<double> of_nodes, of_cells;
};
/// Throws InputError on all ranks if there is no variable of this name. *Collective.*
FieldValues field_values(const Communicator& comm, const LoadedMesh& loaded, const std::string& field);

/// Returns the values at this rank's nodes and ghosts, of one value for each owned node. *Collective.*
std::vector<double> with_ghost_values(const Communicator& comm, const Mesh& mesh, std::vector<double> values);

/// Returns the mean of the cells around each node and ghost. *Collective.*
std::vector<double> means_at_nodes(const Communicator& comm, const Mesh& mesh,
                                   const std::vector<double>& of_cells);

/// Colours this rank's `cells` (numbers as for cell_nodes); legend and bar are those of all ranks' cells.
/// Throws InputError on all ranks if the field does not exist. *Collective.*
CellPaint paint_cells(const Communicator& comm, const LoadedMesh& loaded,
                      const std::vector<std::size_t>& cells, const PlotOptions& options);

}  // namespace quadloop::io
