#pragma once

#include <cstdint>

#include "adapt/morph/boundary_motion.hpp"

namespace quadloop::adapt {

/// Result of a morph, over all ranks.
struct MorphReport {
  /// quality_of() the worst cell outside layers; negative: inverted.
  double worst_before = 0, worst_after = 0;
  double largest_move = 0;  ///< of a node
  std::int64_t moved = 0;   ///< number of nodes
  bool smoothed = false;
  double possible_way = 1;  ///< fraction of the motion up to which no cell is inverted, before smoothing
  Point worst_place;  ///< location of the first inversions if cells cannot follow: a node of the worst cell
  bool valid() const { return worst_after > 0; }
};

/// Moves the nodes of a mesh to a changed geometry; the cells do not change. Boundary nodes move by
/// boundary_motion(), columns of layers on walls with their feet, all others follow the boundary and the
/// outer edges of layers (InverseDistance). Without smoothing, node positions are smooth functions of the new
/// geometry's points; so smoothing is applied only if the worst cell loses more than a fifth of its quality.
/// Then the cells outside layers that lose as much are smoothed, and those near them, except owned nodes
/// flagged in `inner`, if given: those between blocks and of inner lines. If the mesh cannot follow, it is
/// left with inverted cells and the report contains the possible fraction. Bitwise independent of the number
/// of ranks. Throws InputError as boundary_motion() does, and if the two sides of a periodic pair do not move
/// alike. *Collective.*
MorphReport morph_mesh(const Communicator& comm, Mesh& mesh, const OutlineChange& change,
                       const NodeFlags& inner = {});

}  // namespace quadloop::adapt
