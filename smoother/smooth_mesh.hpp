#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "smoother/smooth_options.hpp"

namespace quadloop::smoother {

/// Options for a mesh most of whose quadrilaterals are parallelograms that should be kept. The grid lines
/// between quadtree levels are not shifted (`level_transitions`), because a shift skews the quadrilaterals at
/// the ends of the line. The nodes of parallelograms stay fixed unless a nearby cell is worse than the
/// triangles at hanging nodes, which are right triangles with legs 1 and 2.
SmoothOptions sparing_parallelograms(SmoothOptions options);

/// Results of smoothing, over all ranks.
struct SmoothReport {
  int sweeps = 0;
  std::int64_t free_nodes = 0, moves = 0;
  double worst_cost_before = 0, worst_cost_after = 0;    ///< Eq. 3.2, over all cells
  std::int64_t inverted_before = 0, inverted_after = 0;  ///< cells
  /// Filled only if the mesh is kept Delaunay without `keep_slots`. The flips then rebuild the list of
  /// triangles: it contains, for each original triangle i in order, standing[i] consecutive triangles. This
  /// number is 1 if the triangle was not flipped; otherwise it is that of the new triangles in its place.
  std::vector<std::int32_t> standing;
};

/// Moves nodes to improve the cells' shapes (thesis 3.7). Connectivity changes only by the flips of a
/// Delaunay mesh. Positions, ghost copies included, have the same bits on any number of ranks. The mesh's
/// largest cost does not increase, and without targets its smallest angle does not decrease. If the flips
/// after smoothing produce triangles above the original largest cost, smoothing is repeated with the nodes
/// near those triangles fixed. A mesh with inverted cells is untangled as far as possible; the report counts
/// the inverted cells that remain. Lengths may have any magnitude of a double. *Collective.*
SmoothReport smooth_mesh(const Communicator& comm, Mesh& mesh, const SmoothOptions& options);

}  // namespace quadloop::smoother
