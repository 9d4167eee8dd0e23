#pragma once

#include <cstdint>
#include <vector>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"

namespace quadloop {

/// The part, from 0, that each of this rank's cells goes to.
struct CellParts {
  std::int32_t parts = 1;
  std::vector<std::int32_t> triangles, quads;
};

/// Divides the cells into parts for the ranks of a solver: pieces of the Hilbert curve through the cells'
/// middles, of equal weights, whose borders then give way for fewer edges between parts (refine_parts). The
/// work of a solver goes with edges, so a cell weighs as much as it has; no part's weight differs from the
/// mean by more than 3 percent or, of small parts, a cell's. No part is empty. The same on any number of
/// ranks. *Collective.* Throws InputError where there are fewer cells than parts.
CellParts partition(const Communicator& comm, const Mesh& mesh, std::int32_t parts);

}  // namespace quadloop
