#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/base/word_table.hpp"
#include "mesher/mesh/field.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop::adapt {

/// Transfer method for nodal values; cell values are always transferred conservatively.
enum class TransferKind { linear, conservative };

inline constexpr WordTable<TransferKind, 2> transfer_words{
    {{"linear", TransferKind::linear}, {"conservative", TransferKind::conservative}}};

/// Effects of a transfer on the variables; the same on every rank.
struct TransferReport {
  std::int64_t outside = 0;        ///< nodes of the new mesh outside the old one; for nodal values only
  std::int64_t cells_outside = 0;  ///< new cells not covered by the old mesh; for cell values only
  std::vector<double> drift;       ///< for each variable, nodal ones first: integral over the new mesh minus
                                   ///< integral over the old mesh
  std::vector<double> relative_drift;  ///< drift relative to the old integral of the variable's absolute
                                       ///< value; 0 if that integral is 0
  std::size_t conserved_from = 0;      ///< variables from this index on are transferred conservatively
  double area_change = 0;              ///< (new area - old area) / old area; 0 if nothing is conserved

  /// The report for a field that is not transferred: all drifts are 0.
  static TransferReport without_drift(const Field& field) {
    const std::vector<double> none(field.width() + field.cells.width(), 0.0);
    return {.drift = none, .relative_drift = none};
  }
};

struct Transferred {
  Field field;  ///< values at the new mesh's owned nodes and cells; the constants of the old field
  TransferReport report;
};

/// Transfers nodal and cell values from one mesh to another.
///
/// Linear: a node inside an old triangle (quads are split into two triangles, parts_of()) gets the linear
/// interpolant there: exact for linear fields up to rounding, and bitwise the old value at a coincident node.
/// If it lies in several triangles, the one with the lowest global number is used. A node outside the old
/// mesh gets the value at the nearest point of the old boundary; ties are resolved by the lowest edge number.
/// Nodes in wall layers are located in the old mesh by wall distance (column_places). Each new value
/// lies between the smallest and the largest value at the old nodes from which it is interpolated. The result
/// is bitwise independent of the partitions of the two meshes.
///
/// Conservative: linear transfer with a correction that preserves the integrals (conserve_at_nodes()).
///
/// Cell values are transferred by transfer_cells(); a cell outside the old mesh gets the value of the old
/// cell at the nearest boundary edge.
///
/// Of several blocks each is treated as a mesh of its own: no value crosses an interface. A node of an
/// interface gets the value of the first of its blocks. The blocks of both meshes correspond by their order;
/// InputError if their numbers differ. The relative drifts are those of the block with the largest one.
///
/// `old_field` must have finite values for each owned node and each cell. Each rank processes the old
/// triangles and new nodes in a part of the plane; the old boundary edges are gathered on all ranks if some
/// node is outside. *Collective.*
Transferred transfer(const Communicator& comm, const Mesh& old_mesh, const Field& old_field,
                     const Mesh& new_mesh, TransferKind kind = TransferKind::linear);

}  // namespace quadloop::adapt
