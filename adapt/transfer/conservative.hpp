#pragma once

#include <vector>

#include "adapt/transfer/locate/baffle_places.hpp"
#include "adapt/transfer/locate/curve_partition.hpp"
#include "adapt/transfer/overlap/broken_field.hpp"

namespace quadloop::adapt {

/// One of the two meshes of a transfer, with its triangles (cell_triangles()). Nodes of the new mesh may be
/// shifted relative to the old one (column_places()).
struct TransferSide {
  const Mesh& mesh;
  std::vector<CellTriangle> triangles;
  const BafflePlaces* baffles = nullptr;  ///< of both meshes; null: there are none
};

/// Means over the cells of a new mesh from those of an old mesh: means of the limited linear functions in the
/// old cells (broken_cells()) over each new cell. Where the old mesh covers a new cell the integral is
/// conserved to rounding; elsewhere the mean is that of the covered part. No value exceeds the range of the
/// old cells around those that contribute. Cells not covered by the old mesh are listed in `outside` by local
/// index and have no value. The same bits on any number of ranks. *Collective.*
struct TransferredCells {
  std::vector<double> values;  ///< a row for each local cell
  std::vector<std::int64_t> outside;
};
TransferredCells transfer_cells(const Communicator& comm, const CurvePartition& shares,
                                const TransferSide& old_side, const CellValues& cells,
                                const TransferSide& new_side);

/// Changes the values at owned nodes of a new mesh so that the integral over the part within the old mesh is
/// conserved to rounding. In each new triangle it uses the linear function with the old field's mean and mean
/// gradient there, limited to the range of the old values over the triangle; a node gets the area-weighted
/// mean of its triangles. Exact for linear functions; creates no new extrema. This is the P1-conservative
/// interpolation of Alauzet and Mehrenberger, "P1-conservative solution interpolation on unstructured
/// triangular meshes", Int. J. Numer. Meth. Engng 84 (2010). Triangles not covered by the old mesh do not
/// count; nodes without other triangles keep their values. `areas_of` is the new mesh with unshifted nodes,
/// for the areas. `old_field` has rows for ghost copies. The same bits on any number of ranks. *Collective.*
void conserve_at_nodes(const Communicator& comm, const CurvePartition& shares, const TransferSide& old_side,
                       const Field& old_field, const TransferSide& new_side, const Mesh& areas_of,
                       std::vector<double>& values);

}  // namespace quadloop::adapt
