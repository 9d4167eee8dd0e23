#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// What a distributed mesh is like for those who solve on it; over all ranks.
struct ShapeFigures {
  std::int64_t quads = 0, parallelograms = 0;       ///< those quads whose skew_of is at most parallel_skew
  std::int64_t inner_nodes = 0, inexact_nodes = 0;  ///< nodes off the boundary; those at which median-dual
                                                    ///< cells are not exact for linear fields
  /// Of the two cells at an inner edge, the larger area by the smaller; 0 without inner edges.
  double area_ratio_max = 0;
  /// Cells that fill a passage: all nodes on the boundary, but no two boundary edges that meet.
  std::int64_t passage_cells = 0;

  double parallelogram_share() const {
    return quads == 0 ? 1 : static_cast<double>(parallelograms) / static_cast<double>(quads);
  }
  double inexact_share() const {
    return inner_nodes == 0 ? 0 : static_cast<double>(inexact_nodes) / static_cast<double>(inner_nodes);
  }
};

/// A node counts as inexact where the sum over its edges of (middle of the edge) x (face of the median dual
/// that the edge crosses), which should be the dual cell's area times the unit matrix, misses that by more
/// than 0.2 percent of the area: a scheme that takes a linear flux at the middles of edges, as node-centred
/// solvers do, is wrong there by as much. Triangles and parallelograms miss nothing. The same on any number
/// of ranks. *Collective.*
ShapeFigures shape_figures(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
