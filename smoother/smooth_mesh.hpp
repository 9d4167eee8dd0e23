#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop {

/// For a mesh whose quadrilaterals are parallelograms, most of which are to stay so: level lines do not move,
/// as that costs parallelograms at their ends, and cells as bad as those at hanging nodes (right triangles
/// with legs 1 and 2) free no nodes.
SmoothOptions sparing_parallelograms(SmoothOptions options);

/// What the smoother did, over all ranks.
struct SmoothReport {
  int sweeps = 0;
  std::int64_t free_nodes = 0, moves = 0;
  double worst_cost_before = 0, worst_cost_after = 0;    ///< Eq. 3.2, over all cells
  std::int64_t inverted_before = 0, inverted_after = 0;  ///< cells
  std::vector<std::int32_t> standing;  ///< without `keep_slots`, after flips: how many triangles stand in
                                       ///< the slot of each of this rank's before
};

/// Moves nodes to better the cells' shapes, T 3.7; connectivity stays but for the flips of a Delaunay mesh.
/// The positions are the same bits on any number of ranks, those of the mesh's copies too. Neither the
/// largest cost nor, without targets, the smallest angle of the mesh gets worse, after flips either: where
/// they would make the largest cost worse, nodes near stay. A mesh with inverted cells is untangled as far as
/// may be: whether any are left stands in the report. Lengths may be of any size that a double holds.
/// *Collective.*
SmoothReport smooth_mesh(const Communicator& comm, Mesh& mesh, const SmoothOptions& options);

}  // namespace quadloop
