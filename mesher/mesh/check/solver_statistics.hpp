#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Statistics of a distributed mesh for flow solvers, over all ranks.
struct SolverStatistics {
  std::int64_t quads = 0, parallelograms = 0;  ///< parallelograms: quads with skew_of() at most parallel_skew
  /// Nodes off the boundary; those where median-dual cells are not exact for linear fields.
  std::int64_t inner_nodes = 0, inexact_nodes = 0;
  /// Largest ratio of the two cell areas at an inner edge; 0 without inner edges.
  double area_ratio_max = 0;
  /// Cells that span a passage: all nodes are on the boundary, but no two boundary edges of the cell meet.
  std::int64_t passage_cells = 0;

  double parallelogram_share() const {
    return quads == 0 ? 1 : static_cast<double>(parallelograms) / static_cast<double>(quads);
  }
  double inexact_share() const {
    return inner_nodes == 0 ? 0 : static_cast<double>(inexact_nodes) / static_cast<double>(inner_nodes);
  }
};

/// Computes the statistics. A node counts as inexact if the sum over its edges of (midpoint of the edge) x
/// (face of the median dual crossed by the edge), which should be the dual area times the identity matrix,
/// differs from it by more than 0.2 % of the area: the error of a node-centred scheme that evaluates a linear
/// flux at edge midpoints. Triangles and parallelograms are exact. Independent of the number of ranks.
/// *Collective.*
SolverStatistics solver_statistics(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
