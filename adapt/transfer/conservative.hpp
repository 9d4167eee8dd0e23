#pragma once

#include <vector>

#include "adapt/transfer/locate/curve_shares.hpp"
#include "adapt/transfer/overlap/broken_field.hpp"

namespace quadloop {

/// One of the two meshes of a transfer, with its triangles (cell_triangles()). Nodes of the new one may have
/// been moved for the comparison with the old one (column_places()).
struct TransferSide {
  const Mesh& mesh;
  std::vector<CellTriangle> triangles;
};

/// Means over the cells of a new mesh, from those over the cells of an old one: of what lies over a new cell,
/// by a limited linear function in each old one (broken_cells()). Where the old mesh covers the new cell its
/// integral there is kept to rounding; elsewhere the mean is that of the part which it covers. No value
/// leaves the range of the old cells round what it is made from. Cells that the old mesh does not cover are
/// in `outside`, by their place among this rank's, without a value. The same bits on any number of ranks.
/// *Collective.*
struct CarriedCells {
  std::vector<double> values;  ///< a row for each of this rank's cells
  std::vector<std::int64_t> outside;
};
CarriedCells carry_cells(const Communicator& comm, const CurveShares& shares, const TransferSide& old_side,
                         const CellValues& cells, const TransferSide& new_side);

/// Changes the values at owned nodes of a new mesh to ones that keep the integral, where it lies within the
/// old one, to rounding: over each new triangle the linear function with the old field's mean and mean
/// gradient there, its deviations lowered until it is within the old values that lie over the triangle; at a
/// node the mean of its triangles by area. Exact for linear functions; no new extrema. That is the
/// P1-conservative interpolation of Alauzet and Mehrenberger, "P1-conservative solution interpolation on
/// unstructured triangular meshes", Int. J. Numer. Meth. Engng 84 (2010). Triangles that the old mesh does
/// not cover do not count; nodes that have no other keep what they have. `areas_of` has the nodes where they
/// are, for the areas. `old_field` has rows for copies. The same bits on any number of ranks. *Collective.*
void conserve_at_nodes(const Communicator& comm, const CurveShares& shares, const TransferSide& old_side,
                       const Field& old_field, const TransferSide& new_side, const Mesh& areas_of,
                       std::vector<double>& values);

}  // namespace quadloop
