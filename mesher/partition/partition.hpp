#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The part, from 0, of each of this rank's cells.
struct CellParts {
  std::int32_t parts = 1;
  std::vector<std::int32_t> triangles, quads;
};

/// Partitions the cells for the ranks of a solver: segments of equal weight of the Hilbert curve through the
/// cell centres, then refined for fewer edges between parts (refine_parts). The weight of a cell is its
/// number of edges, as the work of a solver is proportional to edges. The weight of a part differs from the
/// mean by at most 3 percent or, for small parts, by that of a cell. No part is empty. Independent of the
/// number of ranks. Throws InputError if there are fewer cells than parts. *Collective.*
CellParts partition(const Communicator& comm, const Mesh& mesh, std::int32_t parts);

}  // namespace quadloop
