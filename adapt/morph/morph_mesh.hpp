#pragma once

#include <cstdint>

#include "adapt/morph/boundary_motion.hpp"

namespace quadloop {

/// What came of a morph, over all ranks.
struct MorphReport {
  double worst_before = 0, worst_after = 0;  ///< quality_of the worst cell outside layers; negative: inverted
  double largest_move = 0;                   ///< of a node
  std::int64_t moved = 0;                    ///< nodes
  bool smoothed = false;
  double possible_way = 1;  ///< share of the way up to which no cell is inverted, before smoothing
  Point worst_place;        ///< where cells that cannot follow turn over: a node of the worst one
  bool valid() const { return worst_after > 0; }
};

/// Moves the nodes of a mesh to a changed outline; the cells stay the same. Boundary nodes go where
/// boundary_motion says, columns of layers on walls with their feet, all others follow the boundary and the
/// fronts of layers (InverseDistance). Without smoothing, nodes are a smooth function of the new outline's
/// points; so they stay unless the worst cell has lost more than a fifth of its quality, whereupon the cells
/// outside layers that have lost as much are smoothed, with those near them, but for owned nodes flagged in
/// `interfaces`, if that is given. A mesh that cannot follow is left with inverted cells: the report tells
/// how far it could. The same bits on any number of ranks. *Collective.* Throws InputError as
/// boundary_motion().
MorphReport morph_mesh(const Communicator& comm, Mesh& mesh, const OutlineChange& change,
                       const NodeFlags& interfaces = {});

}  // namespace quadloop
