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
      0;                   ///< the first of these variables whose integral is to be kept; all later are
  double area_change = 0;  ///< of the new mesh against the old one, as a fraction; 0 if nothing is conserved

  /// Of a field that stays on its mesh.
  static TransferReport without_drift(const Field& field) {
    const std::vector<double> none(field.width() + field.cells.width(), 0.0);
    return {.drift = none, .relative_drift = none};
  }
};

struct Transferred {
  Field field;  ///< rows for the new mesh's owned nodes and its cells; constants of the old field
  TransferReport report;
};

/// Carries values from the nodes and cells of one mesh to those of another. Linear: a node inside an old
/// triangle, or in half of a quad (parts_of), takes the values interpolated linearly there: those of an old
/// node at the same place bit for bit, linear fields to rounding. Of several triangles that it lies in it is
/// the one of the lowest number over all ranks. A node outside the old mesh takes the values at the nearest
/// point of its boundary edges, of several edges as near those of the lowest number. In layers at walls nodes
/// go by their height above the wall (column_places). So no value leaves the range of the nodes that it is
/// made from, and the bits depend on the two meshes alone, not on how they are spread over the ranks.
/// Conservative: that, changed so that integrals are kept (conserve_at_nodes()). Values of cells go as
/// carry_cells() says; a cell outside the old mesh takes those of the old cell at the nearest of its boundary
/// edges. `old_field` holds a row of finite numbers for each owned node and each cell. Each rank works on a
/// share of the old triangles and new nodes, told by place; the old boundary edges are gathered on all ranks
/// if some node is outside. *Collective.*
Transferred transfer(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                     const Mesh& new_mesh, TransferKind kind = TransferKind::linear);

}  // namespace quadloop
