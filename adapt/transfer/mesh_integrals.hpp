#pragma once

#include <span>
#include <vector>

#include "adapt/transfer/cell_triangles.hpp"
#include "adapt/transfer/node_rows.hpp"

namespace quadloop {

/// Of each variable, over the whole mesh.
struct MeshIntegrals {
  std::vector<double> of_values, of_sizes;  ///< of q and of |q|
};

/// Area times the mean of the corners, summed over the triangles of all ranks; the same bits on any number of ranks. *Collective.*
MeshIntegrals integrate(const Communicator& comm, const Mesh& mesh, std::span<const CellTriangle> triangles, const NodeRows& rows);

}  // namespace quadloop
