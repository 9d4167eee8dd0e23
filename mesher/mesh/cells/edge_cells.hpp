#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Neighbour cells of edges, by global cell numbers, triangles before quads, from 0.
struct EdgeCells {
  static constexpr std::int64_t none = -1;

  /// For each edge of this rank's cells, in the order of for_each_cell_edge(): the cell on the other side.
  std::vector<std::int64_t> across;
  /// For each boundary edge, boundary after boundary: the cell to its left.
  std::vector<std::int64_t> of_boundary;
  std::int64_t first_triangle = 0, first_quad = 0;  ///< global numbers of this rank's first cells
};

/// The mesh must be valid. A boundary edge may be stored on a rank that has neither of its cells.
/// *Collective.*
EdgeCells edge_cells(const Communicator& comm, const Mesh& mesh);

/// For each boundary edge, boundary after boundary, the cell to its left, or to its right: none on an outer
/// boundary. Where cells overlap, one of several. *Collective.*
std::vector<std::int64_t> cells_left_of_boundaries(const Communicator& comm, const Mesh& mesh);
std::vector<std::int64_t> cells_right_of_boundaries(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
