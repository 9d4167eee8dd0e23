#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "mesher/base/communicator.hpp"
#include "mesher/delaunay/tie_order.hpp"
#include "mesher/geometry/geometry.hpp"
#include "mesher/mesh/mesh.hpp"
#include "smoother/node/node_solver.hpp"
#include "smoother/node_stars.hpp"

namespace quadloop {

/// How a mesh is smoothed.
struct SmoothOptions {
  int sweeps = 20;  ///< at most; fewer where nothing moves any more
  Objective objective = Objective::power;
  Method method = Method::perturb;
  /// Nodes of cells that cost no more stay, unless they share a cell with a node of one that does.
  double threshold = 0.05;
  /// First moves lines where squares of two sizes meet, which lifts 26.6 degrees to 29.7.
  bool level_lines = true;
  double bad = 0.072;  ///< nodes of parallelograms stay unless a cell that costs more is near; one below 28
                       ///< degrees does
  const Geometry* geometry = nullptr;  ///< the outline that boundary nodes slide along; without it they slide
                                       ///< where the mesh's own is straight
  std::vector<char> even_segments;     ///< a flag for each segment of the geometry along which the nodes are to
                                       ///< be spread evenly, or none at all
  NodeFlags pinned;                    ///< a flag for each owned node that must stay, or none at all
  std::function<TieRank(Point)> delaunay;  ///< if set, the mesh is Delaunay under this order of nodes, and is
                                           ///< made so again by flips in the end
  /// Of each own triangle, or none: flips keep edges between two blocks.
  std::vector<std::int32_t> triangle_to_block;
  bool keep_slots = true;  ///< triangles made by flips take the slots in the order that become free, else
                           ///< those beside them; not with blocks
  std::vector<CellTarget> targets;  ///< the shape of each own cell, triangles, then quads; or none at all for
                                    ///< ideal ones. Not with `delaunay`
};

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
/// largest cost nor the smallest angle of the mesh gets worse, after flips either: where they would make the
/// largest cost worse, nodes near stay. A mesh with inverted cells is untangled as far as may be: whether any
/// are left stands in the report. Lengths may be of any size that a double holds. *Collective.*
SmoothReport smooth_mesh(const Communicator& comm, Mesh& mesh, const SmoothOptions& options);

}  // namespace quadloop
