#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/word_table.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Transfer method for nodal values; cell values are always transferred conservatively.
enum class TransferKind { linear, conservative };

inline constexpr WordTable<TransferKind, 2> transfer_words{
    {{"linear", TransferKind::linear}, {"conservative", TransferKind::conservative}}};

/// Effects of a transfer on the variables; the same on every rank.
struct TransferReport {
  std::int64_t outside = 0;        ///< nodes of the new mesh outside the old one; for nodal values only
  std::int64_t cells_outside = 0;  ///< new cells not covered by the old mesh; for cell values only
  std::vector<double> drift;  ///< for each variable, nodal ones first: its integral over the new mesh minus
                              ///< that over the old one
  std::vector<double> relative_drift;  ///< drift relative to the old integral of the variable's absolute
                                       ///< value; 0 if that is 0
  std::size_t conserved_from =
      0;  ///< index of the first variable whose integral is conserved; all later ones are too
  double area_change = 0;  ///< relative change of the mesh area; 0 if nothing is conserved
};

struct Transferred {
  Field field;  ///< rows for the new mesh's owned nodes and its cells; constants of the old field
  TransferReport report;
};

/// Transfers values from the nodes and cells of one mesh to those of another. Linear: a node inside an old
/// triangle, or half of a quadrilateral (split_quad), gets linearly interpolated values: exactly those of an
/// old node at the same place; exact to rounding for linear fields. Of several triangles that contain it the
/// one with the lowest global number is used. A node outside the old mesh gets the values at the nearest
/// point of its boundary edges, of equally near edges the lowest-numbered one. In wall layers nodes are
/// mapped by their height above the wall (column_places). So no value exceeds the range of the nodes from
/// which it is computed, and the bits depend on the two meshes only, not on their partition. Conservative:
/// the same, corrected to conserve integrals (conserve_at_nodes()). Cell values are transferred by
/// carry_cells(); a cell outside the old mesh gets the values of the old cell at the nearest boundary edge.
/// `old_field` has a row of finite numbers for each owned node and each cell. Each rank handles a part of the
/// plane with its old triangles and new nodes; the old boundary edges are gathered on all ranks if some node
/// is outside. *Collective.*
Transferred transfer(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                     const Mesh& new_mesh, TransferKind kind = TransferKind::linear);

}  // namespace quadloop
