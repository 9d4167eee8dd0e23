#pragma once

#include <span>
#include <vector>

#include "adapt/transfer/equal_cells.hpp"
#include "adapt/transfer/locate/baffle_places.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "adapt/transfer/overlap/broken_field.hpp"

namespace quadloop::adapt {

/// The two meshes of a conservative transfer.
struct MeshPair {
  const CurvePartition& shares;
  const Mesh& old_mesh;
  const Mesh& new_mesh;
  Point old_centre, new_centre;   ///< centre_of_nodes()
  std::span<const Point> places;  ///< of the new mesh's nodes in the old one (column_places()), with ghosts
  const BafflePlaces* baffles;    ///< of both meshes; null: there are none
  EqualCells equal;               ///< quads count as equal only if the centres are
};

/// Means over the cells of a new mesh from those of an old mesh: means of the limited linear functions in the
/// old cells (broken_cells()) over each new cell. Where the old mesh covers a new cell the integral is
/// conserved to rounding; elsewhere the mean is that of the covered part. No value exceeds the range of the
/// old cells around those that contribute. A cell that the old mesh has as well keeps its mean. Cells not
/// covered by the old mesh are listed in `outside` by local index and have no value. The same bits on any
/// number of ranks. *Collective.*
struct TransferredCells {
  std::vector<double> values;  ///< a row for each local cell
  std::vector<std::int64_t> outside;
};
TransferredCells transfer_cells(const Communicator& comm, const MeshPair& meshes, const CellValues& cells);

/// Changes the values at owned nodes of a new mesh so that the integral over the part within the old mesh is
/// conserved to rounding. In each new triangle it uses the linear function with the old field's mean and mean
/// gradient there, limited to the range of the old values over the triangle; a node gets the area-weighted
/// mean of its triangles. Exact for linear functions; creates no new extrema. This is the P1-conservative
/// interpolation of Alauzet and Mehrenberger, "P1-conservative solution interpolation on unstructured
/// triangular meshes", Int. J. Numer. Meth. Engng 84 (2010). Triangles not covered by the old mesh do not
/// count; nodes without other triangles keep their values, as do those with equal cells only
/// (find_equal_cells): only changed cells are intersected. `values` are those of the linear transfer, which
/// has the old values at the corners of equal cells. `old_field` has rows for ghosts. The same bits on any
/// number of ranks. *Collective.*
void conserve_at_nodes(const Communicator& comm, const MeshPair& meshes, const Field& old_field,
                       std::vector<double>& values);

}  // namespace quadloop::adapt
