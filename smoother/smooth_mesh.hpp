#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop::smoother {

/// Options for a mesh most of whose quadrilaterals are parallelograms that should be kept: level lines are
/// not moved, as that skews quadrilaterals at their ends, and cells as bad as those at hanging nodes (right
/// triangles with legs 1 and 2) free no nodes.
SmoothOptions sparing_parallelograms(SmoothOptions options);

/// Results of smoothing, over all ranks.
struct SmoothReport {
  int sweeps = 0;
  std::int64_t free_nodes = 0, moves = 0;
  double worst_cost_before = 0, worst_cost_after = 0;    ///< Eq. 3.2, over all cells
  std::int64_t inverted_before = 0, inverted_after = 0;  ///< cells
  std::vector<std::int32_t> standing;  ///< without `keep_slots`, after flips: number of triangles stored in
                                       ///< the slot of each of this rank's original triangles
};

/// Moves nodes to improve the cells' shapes (thesis 3.7). Connectivity changes only by the flips of a
/// Delaunay mesh. Positions, ghost copies included, have the same bits on any number of ranks. Neither the
/// mesh's largest cost nor (without targets) its smallest angle gets worse: where flips would raise the
/// largest cost, the nodes nearby stay. A mesh with inverted cells is untangled as far as possible; the
/// report counts the inverted cells that remain. Lengths may have any magnitude of a double. *Collective.*
SmoothReport smooth_mesh(const Communicator& comm, Mesh& mesh, const SmoothOptions& options);

}  // namespace quadloop::smoother
