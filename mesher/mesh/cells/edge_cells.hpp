#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// Cells of a plane mesh by the numbers over all ranks, triangles before quads, from 0.
struct EdgeCells {
  static constexpr std::int64_t none = -1;

  std::vector<std::int64_t> across;       ///< at each edge of this rank's cells, as for_each_cell_edge()
                                          ///< visits them: the cell on its other side
  std::vector<std::int64_t> of_boundary;  ///< at each boundary edge, boundary after boundary: the cell to
                                          ///< its left
  std::int64_t first_triangle = 0, first_quad = 0;  ///< numbers of this rank's first
};

/// The mesh is valid. *Collective.*
EdgeCells edge_cells(const Communicator& comm, const Mesh& mesh);

}  // namespace quadloop
