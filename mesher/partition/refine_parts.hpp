#pragma once

#include <cstdint>

#include "mesher/base/parallel/communicator.hpp"
#include "mesher/mesh/mesh.hpp"
#include "mesher/partition/partition.hpp"

namespace quadloop {

/// Weights of cells, and bounds on those of parts.
struct PartWeights {
  std::int64_t of_triangle = 3, of_quad = 4;
  std::int64_t least = 0, most = 0;  ///< of a part
};

/// Moves cells between neighbouring parts to reduce the number of edges between parts. Works on pairs of
/// neighbours: one rank receives the cells near their interface (refine_sides); disjoint pairs are processed
/// concurrently. Independent of the number of ranks; no rank stores more than the cells near the interfaces
/// of its parts. The weights of the parts must be within the bounds and stay there. *Collective.*
void refine_parts(const Communicator& comm, const Mesh& mesh, const PartWeights& weights, CellParts& cells);

}  // namespace quadloop
